#include <culm/load/moment_load.hpp>
#include <culm/load/slot_load.hpp>
#include <culm/math/rotation.hpp>

#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <functional>
#include <memory>

namespace culm::load {
namespace {

using Make = std::function<std::unique_ptr<model::Batch>(const model::NodeTable&)>;

/// Work of a load over the step of a state, in the coordinates of the multiplier form.
struct Step {
  model::State state;
  Vec3 prev_point, next_point, cayley;
  double work = 0.0;
};

const Vec3 components(1.3, -2.1, 0.7);
const Vec3 offset(0.2, -0.5, 0.3);

Step step_with(const Make& make) {
  model::Model model;
  model.nodes().add(kit::random_node(1));
  model.add_load(make(model.nodes()));
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

constexpr double round_off = 1e-14;

TEST(Work, OfADeadForceIsForceTimesTheMotionOfItsPoint) {
  const Step step = step_with([](const model::NodeTable& nodes) {
    auto load = std::make_unique<SlotLoad>("Force", nodes, model::Amplitude::constant());
    model::Marker point = model::marker_at(0);
    point.offset = offset;
    load->add_force(point, components, Axes::space);
    return load;
  });
  EXPECT_NEAR(step.work, components.dot(step.next_point - step.prev_point), round_off);
}

// @source formulation 3.1
TEST(Work, OfAMomentIsMomentTimesCayleyVectorOfTheStep) {
  const Step step = step_with([](const model::NodeTable& nodes) {
    auto load =
        std::make_unique<MomentLoad>("Moment", nodes, model::Amplitude::constant(), Axes::space);
    load->add_moment(0, components);
    return load;
  });
  ASSERT_GT(step.cayley.norm(), 0.5);
  EXPECT_NEAR(step.work, components.dot(step.cayley), round_off);
}

}  // namespace
}  // namespace culm::load
