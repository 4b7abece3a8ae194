#include "sample_load.hpp"

#include <culm_kit/load_contract.hpp>
#include <gtest/gtest.h>

namespace culm::load {
namespace {

using kit::effect;
using model::NodeTable;

void fill_with_moment(model::Model& model, bool with_slave) {
  model.nodes().add(kit::random_shell_node(10), NodeKind::node6);
  auto load = std::make_unique<MomentLoad>(effect, model.nodes(), model::Amplitude::constant(),
                                           Axes::space);
  load->add_moment(0, components);
  model.add_load(std::move(load));
  if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
}

TEST(DirectorMoment, TangentIsDerivativeOfResidual) {
  for (const bool with_slave : {false, true}) {
    SCOPED_TRACE(with_slave);
    // fourth order in the step; the force is a rational function of the director
    kit::expect_tangent_is_derivative(
        [=](model::Model& model) { fill_with_moment(model, with_slave); }, effect, 5e-4);
  }
}

TEST(DirectorMoment, NullSpaceResidualIsProjected) {
  for (const bool with_slave : {false, true}) {
    SCOPED_TRACE(with_slave);
    kit::expect_residual_is_projected(
        [=](model::Model& model) { fill_with_moment(model, with_slave); }, effect);
  }
}

// d x f = m - (m . d) d / (d . d) and f . d = 0: the couple across the director, no stretching.
TEST(DirectorMoment, IsACoupleAcrossTheDirector) {
  model::Model model;
  fill_with_moment(model, false);
  model.freeze(model::Form::null_space);
  kit::DenseAssembly dense(model);
  const model::State state = kit::random_state(model, 3);
  for (const Stencil& stencil : kit::law_stencils) {
    const Eigen::VectorXd r = dense.residual(state, stencil, {kit::find_batch(model, effect)});
    const model::Coordinates q = kit::at_theta(state, stencil.theta);
    const Vec3 d = NodeTable::slots(q, 0).col(1);
    const Vec3 f = -r.segment<3>(3);
    const Vec3 across = components - components.dot(d) / d.squaredNorm() * d;
    EXPECT_TRUE(r.head<3>().isZero(0.0));
    EXPECT_LT((d.cross(f) - across).norm(), 1e-14);
    EXPECT_LT(std::abs(f.dot(d)), 1e-14);
  }
}

// The work booked is that of the forces, and the moment the one that acts.
TEST(DirectorMoment, BooksItsWorkAndMoment) {
  model::Model model;
  fill_with_moment(model, false);
  model.freeze(model::Form::null_space);
  kit::DenseAssembly dense(model);
  const model::State state = kit::random_state(model, 3);
  const Stencil stencil = Stencil::midpoint(0.4);
  const model::Batch* batch = kit::find_batch(model, effect);
  const Eigen::VectorXd r = dense.residual(state, stencil);
  const model::StepWork work = batch->step_work(state, stencil);
  const Vec3 moved =
      NodeTable::slots(state.next, 0).col(1) - NodeTable::slots(state.prev, 0).col(1);
  const Vec3 d = NodeTable::slots(kit::at_theta(state, 0.5), 0).col(1);
  EXPECT_NEAR(work.external, -r.segment<3>(3).dot(moved), 1e-14);
  EXPECT_LT((work.moment + d.cross(Vec3(r.segment<3>(3)))).norm(), 1e-14);
}

}  // namespace
}  // namespace culm::load
