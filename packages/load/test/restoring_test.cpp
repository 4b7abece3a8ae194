#include <culm/load/restoring.hpp>
#include <culm/math/rotation.hpp>

#include <culm_kit/batch_laws.hpp>
#include <culm_kit/load_contract.hpp>
#include <culm_kit/no_heap.hpp>
#include <gtest/gtest.h>

#include <memory>

namespace culm::load {
namespace {

using kit::effect;
using model::NodeTable;

Mat6 random_matrix(int seed) {
  std::srand(static_cast<unsigned>(seed));
  return Mat6::Random();
}

RestoringLoad::Values values() {
  RestoringLoad::Values values;
  values.preload << 1.0, -2.0, 0.5, 0.3, 0.8, -0.6;
  values.stiffness = random_matrix(1) * random_matrix(1).transpose();
  values.damping = random_matrix(2) * random_matrix(2).transpose();
  values.quadratic = Vec6(0.2, 0.1, 0.4, 0.3, 0.5, 0.6).asDiagonal();
  return values;
}

void fill_with_springs(model::Model& model, bool with_slave) {
  model.nodes().add(kit::random_node(10));
  auto load = std::make_unique<RestoringLoad>(effect, model.nodes(), values());
  load->add(0);
  model.add_load(std::move(load));
  if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
}

TEST(Restoring, TangentIsDerivativeOfResidual) {
  for (const bool with_slave : {false, true}) {
    kit::expect_tangent_is_derivative(
        [&](model::Model& model) { fill_with_springs(model, with_slave); }, effect, 1e-3);
  }
}

TEST(Restoring, AttemptsLeaveNoTrace) {
  kit::expect_attempts_leave_no_trace([](model::Model& model) { fill_with_springs(model, true); },
                                      effect);
}

TEST(Restoring, AssembleAllocatesNothing) {
  kit::expect_no_allocation([](model::Model& model) { fill_with_springs(model, true); }, effect);
}

// What the forces do in a step is what is stored, and what is booked as damped.
TEST(Restoring, KeepsTheEnergyOfAStep) {
  for (int seed = 3; seed < 20; ++seed) {
    model::Model model;
    fill_with_springs(model, false);
    model.freeze(model::Form::multipliers);
    const model::State state = kit::random_state(model, seed);
    kit::DenseAssembly dense(model);
    model::Batch* batch = kit::find_batch(model, effect);
    const Stencil stencil = Stencil::midpoint(0.4);
    const Vec<12> force = -dense.residual(state, stencil, {batch}).head<12>();
    const Eigen::Map<const Vec<12>> prev(state.prev.data());
    const Eigen::Map<const Vec<12>> next(state.next.data());
    const model::StepWork work = batch->step_work(state, stencil);
    const double stored = batch->stored_energy(state.next) - batch->stored_energy(state.prev);
    EXPECT_GT(work.damping, 0.0);
    EXPECT_NEAR(-force.dot(next - prev), work.damping + stored, 1e-13 * (1.0 + work.damping));
    const kit::Resultant total = kit::resultant_of(force, kit::at_theta(state, 0.5));
    EXPECT_LT((total.force - work.force).norm(), 1e-13);
    EXPECT_LT((total.moment - work.moment).norm(), 1e-13);
  }
}

// Force and moment about the node are those of the matrix for a small displacement and turn.
TEST(Restoring, ForcesAreThoseOfTheMatrices) {
  constexpr double small = 1e-5;
  RestoringLoad::Values springs = values();
  springs.preload.setZero();
  model::Model model;
  model.nodes().add(kit::random_node(10));
  auto load = std::make_unique<RestoringLoad>(effect, model.nodes(), springs);
  load->add(0);
  model.add_load(std::move(load));
  model.freeze(model::Form::multipliers);
  model::State state = model.initial_state();
  const Vec6 motion = small * Vec6(0.4, -0.7, 0.2, 0.5, -0.3, 0.9);
  const Mat3 turn = exp_rotation(Vec3(motion.tail<3>()));
  for (model::Coordinates* q : {&state.prev, &state.next}) {
    auto slots = NodeTable::slots(*q, 0);
    slots.col(0) += motion.head<3>();
    slots.rightCols<3>() = (turn * slots.rightCols<3>()).eval();
  }
  kit::DenseAssembly dense(model);
  const Eigen::VectorXd residual =
      dense.residual(state, Stencil::statics(), {kit::find_batch(model, effect)});
  const kit::Resultant total = kit::resultant_of(-residual.head<12>(), state.next);
  const Vec6 expected = -springs.stiffness * motion;
  const Vec3 place = NodeTable::slots(state.next, 0).col(0);
  constexpr double second_order = 20.0 * small * small;
  EXPECT_LT((total.force - expected.head<3>()).norm(), second_order);
  EXPECT_LT((total.moment - place.cross(total.force) - expected.tail<3>()).norm(), second_order);
  EXPECT_GT(expected.norm(), small);
}

}  // namespace
}  // namespace culm::load
