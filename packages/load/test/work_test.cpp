#include <culm/math/rotation.hpp>

#include "sample_load.hpp"

#include <gtest/gtest.h>

namespace culm::load {
namespace {

/// Work of a load over the step of a state, in the coordinates of the multiplier form.
struct Step {
  model::State state;
  Vec3 prev_point, next_point, cayley;
  double work = 0.0;
};

Step step_with(const Make& make) {
  model::Model model;
  model.nodes().add(kit::random_node(1));
  model.add_load(make(model.nodes(), model::Amplitude::constant()));
  model.freeze(model::Form::multipliers);
  Step step;
  step.state = kit::random_state(model, 2);
  kit::DenseAssembly dense(model);
  const Eigen::VectorXd force =
      -dense.residual(step.state, Stencil::midpoint(0.4), {model.batches().back()});
  const model::NodeSlots prev = model::NodeTable::slots(step.state.prev, 0);
  const model::NodeSlots next = model::NodeTable::slots(step.state.next, 0);
  const Vec<12> motion = (next - prev).reshaped<Eigen::ColMajor>();
  step.work = force.head<12>().dot(motion);
  step.prev_point = prev.col(0) + prev.rightCols<3>() * offset;
  step.next_point = next.col(0) + next.rightCols<3>() * offset;
  step.cayley = cayley_vector(prev.rightCols<3>(), next.rightCols<3>());
  return step;
}

TEST(Work, OfADeadForceIsForceTimesTheMotionOfItsPoint) {
  const Step step = step_with(force_in(Axes::space));
  EXPECT_NEAR(step.work, components.dot(step.next_point - step.prev_point), round_off);
}

// @source formulation 3.1
TEST(Work, OfAMomentIsMomentTimesCayleyVectorOfTheStep) {
  const Step step = step_with(moment_in(Axes::space));
  ASSERT_GT(step.cayley.norm(), 0.5);
  EXPECT_NEAR(step.work, components.dot(step.cayley), round_off);
}

}  // namespace
}  // namespace culm::load
