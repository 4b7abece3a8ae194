#include <culm/load/rotation_damper.hpp>
#include <culm/math/rotation.hpp>

#include <culm_kit/batch_laws.hpp>
#include <culm_kit/load_contract.hpp>
#include <culm_kit/no_heap.hpp>
#include <gtest/gtest.h>

#include <memory>

namespace culm::load {
namespace {

using kit::effect;
using kit::oblique;
using model::NodeTable;

class RotationDampers : public testing::TestWithParam<bool> {
 protected:
  static void fill(model::Model& model, bool with_slave) {
    model.nodes().add(kit::random_node(10));
    const PiecewiseLinear moment({-20.0, 0.0, 20.0}, {-30.0, 0.0, 50.0});
    auto damper = std::make_unique<RotationDamper>(effect, model.nodes(), moment);
    damper->add(0, {oblique, GetParam()});
    model.add_load(std::move(damper));
    if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
  }
};

TEST_P(RotationDampers, TangentIsDerivativeOfResidual) {
  for (const bool with_slave : {false, true}) {
    kit::expect_tangent_is_derivative([&](model::Model& model) { this->fill(model, with_slave); },
                                      effect, 1e-3);
  }
}

TEST_P(RotationDampers, TakesExactlyWhatItBooks) {
  for (int seed = 3; seed < 20; ++seed) {
    model::Model model;
    fill(model, false);
    model.freeze(model::Form::multipliers);
    const model::State state = kit::random_state(model, seed);
    kit::DenseAssembly dense(model);
    model::Batch* batch = kit::find_batch(model, effect);
    const Stencil stencil = Stencil::midpoint(0.4);
    const Vec<12> force = -dense.residual(state, stencil, {batch}).head<12>();
    const Eigen::Map<const Vec<12>> prev(state.prev.data());
    const Eigen::Map<const Vec<12>> next(state.next.data());
    const model::StepWork work = batch->step_work(state, stencil);
    EXPECT_GT(work.damping, 0.0);
    EXPECT_NEAR(-force.dot(next - prev), work.damping, 1e-14 * (1.0 + work.damping));
    // and the moment is the one that is booked, also at directors shorter than one
    const kit::Resultant total = kit::resultant_of(force, kit::at_theta(state, 0.5));
    EXPECT_LT(total.force.norm(), 1e-14);
    EXPECT_LT((total.moment - work.moment).norm(), 1e-13);
  }
}

TEST_P(RotationDampers, MomentFollowsTheAngularVelocity) {
  model::Model model;
  fill(model, false);
  model.freeze(model::Form::null_space);
  kit::DenseAssembly dense(model);
  model::State state = model.initial_state();
  const Mat3 D = NodeTable::slots(state.prev, 0).rightCols<3>();
  const Vec3 n = GetParam() ? Vec3(D * oblique) : oblique;
  NodeTable::slots(state.next, 0).rightCols<3>() = exp_rotation(-0.4 * n) * D;
  const Eigen::VectorXd r = dense.residual(state, Stencil::midpoint(0.1));
  EXPECT_LT((r.tail<3>() + 1.5 * 20.0 * std::tan(0.2) * n).norm(), 1e-13);
  EXPECT_EQ(kit::largest(dense.residual(state, Stencil::statics())), 0.0);
}

TEST_P(RotationDampers, AssembleAllocatesNothing) {
  for (const model::Form form : {model::Form::null_space, model::Form::multipliers}) {
    model::Model model;
    fill(model, true);
    model.freeze(form);
    kit::DenseAssembly dense(model);
    const model::State state = kit::random_state(model, 3);
    const kit::DenseAssembly::Batches tested = {kit::find_batch(model, effect)};
    kit::NoHeap guard;
    EXPECT_EQ(dense.assemble(state, Stencil::midpoint(0.4), Want::residual_and_tangent, tested),
              Verdict::ok);
  }
}

INSTANTIATE_TEST_SUITE_P(Axis, RotationDampers, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "Local" : "Space"; });

}  // namespace
}  // namespace culm::load
