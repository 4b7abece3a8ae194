#include <culm/analysis/step_control.hpp>

#include "motion.hpp"

#include <gtest/gtest.h>

namespace culm::analysis {
namespace {

StepSettings fixed(double step, double end) { return {end, step, 1e-3 * step, {}}; }
StepSettings adaptive(double step, double end, double tolerance) {
  return {end, step, 1e-6 * step, AdaptiveSettings{tolerance}};
}

TEST(StepControl, EstimatesTheErrorOfAStep) {
  Motion top(build_top);
  StepControl control(*top.system, adaptive(1e-4, 1.0, 1e9), top.error_constant);
  for (const double h : {1e-4, 1.3e-4, 0.9e-4, 1e-4, 1.1e-4}) {
    ASSERT_TRUE(top.attempt(h).accepted);
    ASSERT_EQ(control.judge(top.state, Stencil::midpoint(h)), solver::StepEnd::converged);
    control.accept(top.state, h);
    top.stepper->accept();
  }
  // one step and the same time in sixteen
  const double h = 1e-4;
  ASSERT_TRUE(top.attempt(h).accepted);
  ASSERT_EQ(control.judge(top.state, Stencil::midpoint(h)), solver::StepEnd::converged);
  const model::Coordinates once = top.state.next;
  top.stepper->discard();
  top.advance(h / 16.0, 16);
  double error = 0.0;
  for (int s = 1; s < 4; ++s) {
    error = std::max(error, (model::NodeTable::slots(once, 0).col(s) -
                             model::NodeTable::slots(top.state.next, 0).col(s))
                                .norm());
  }
  error = top.comm.max(error);  // known to the owner of the node
  ASSERT_TRUE(control.error().has_value());
  EXPECT_NEAR(*control.error() / error, 1.0, 0.05);
}

TEST(StepControl, KnowsNoErrorInTheFirstTwoSteps) {
  Motion top(build_top);
  StepControl control(*top.system, adaptive(1e-3, 1.0, 1e-6), top.error_constant);
  for (int i = 0; i < 3; ++i) {
    const double h = control.end_of_step(top.state.time_prev) - top.state.time_prev;
    ASSERT_TRUE(top.attempt(h).accepted);
    control.judge(top.state, Stencil::midpoint(h));
    EXPECT_EQ(control.error().has_value(), i == 2);
    control.accept(top.state, h);
    top.stepper->accept();
    if (i < 2) {
      EXPECT_DOUBLE_EQ(control.memory().next, h);
    }
  }
}

TEST(StepControl, RepeatsAStepWithAnErrorFarAboveTheTolerance) {
  Motion top(build_top);
  StepControl control(*top.system, adaptive(1e-3, 1.0, 1e-12), top.error_constant);
  const double h = 1e-3;
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(top.attempt(h).accepted);
    ASSERT_EQ(control.judge(top.state, Stencil::midpoint(h)), solver::StepEnd::converged);
    control.accept(top.state, h);
    top.stepper->accept();
  }
  ASSERT_TRUE(top.attempt(h).accepted);
  EXPECT_EQ(control.judge(top.state, Stencil::midpoint(h)), solver::StepEnd::inaccurate);
  control.reject(solver::StepEnd::inaccurate, h);
  EXPECT_DOUBLE_EQ(control.memory().next, 0.5 * h);
  EXPECT_FALSE(control.is_exhausted());
}

TEST(StepControl, StopsRotationsBeforeTheyBecomeAmbiguous) {
  for (const auto& [h, end] :
       {std::pair{0.05, solver::StepEnd::converged}, {0.2, solver::StepEnd::turned_too_far}}) {
    Motion top(build_top);
    // tan(angle / 2) = h omega / 2 about a principal axis
    top.state.velocity.assign(12, 0.0);
    model::NodeTable::slots(top.state.velocity, 0).col(1) = Vec3(0.0, 0.0, -150.0);
    model::NodeTable::slots(top.state.velocity, 0).col(3) = Vec3(150.0, 0.0, 0.0);
    EXPECT_EQ(top.attempt(h).outcome.end, end);
  }
}

TEST(StepControl, AdaptiveStepsTurnAboutFiftyDegreesAtMost) {
  Motion top(build_top);
  const double h = 8e-3;  // 150 / s times h is 1.2
  StepControl control(*top.system, adaptive(h, 1.0, 1e9), top.error_constant);
  ASSERT_TRUE(top.attempt(h).accepted);
  EXPECT_EQ(control.judge(top.state, Stencil::midpoint(h)), solver::StepEnd::turned_too_far);
}

TEST(StepControl, FixedStepsReturnToTheirGrid) {
  const Motion top(build_top);
  StepControl control(*top.system, fixed(0.1, 0.25), top.error_constant);
  EXPECT_DOUBLE_EQ(control.end_of_step(0.0), 0.1);
  control.reject(solver::StepEnd::diverged, 0.1);
  EXPECT_DOUBLE_EQ(control.end_of_step(0.0), 0.05);
  control.accept(top.state, 0.05);
  EXPECT_DOUBLE_EQ(control.end_of_step(0.05), 0.1);
  control.accept(top.state, 0.05);
  EXPECT_DOUBLE_EQ(control.end_of_step(0.1), 0.2);
  EXPECT_EQ(control.end_of_step(0.2), 0.25);
}

TEST(StepControl, AdaptiveStepsEndAtStops) {
  Motion top(build_top);
  const StepControl control(*top.system, adaptive(1.6e-3, 1.0, 1e-6), top.error_constant,
                            {2e-4, 0.5});
  EXPECT_DOUBLE_EQ(control.end_of_step(0.0), 1e-4);
  EXPECT_DOUBLE_EQ(control.end_of_step(1.2e-4), 2e-4);
  EXPECT_DOUBLE_EQ(control.end_of_step(2e-4), 3e-4);
  EXPECT_DOUBLE_EQ(control.end_of_step(0.5 - 1e-5), 0.5);
  EXPECT_DOUBLE_EQ(control.end_of_step(0.5), 0.5 + 1e-4);
}

TEST(StepControl, AdaptiveStepsMeetTheEndWithoutASliver) {
  const Motion top(build_top);
  const auto next = [&](double end) {
    const StepControl control(*top.system, adaptive(1.6, end, 1e-3), 1.0 / 12.0);
    return control.end_of_step(0.0);
  };
  const double first = next(10.0);
  EXPECT_EQ(next(0.9 * first), 0.9 * first);
  EXPECT_DOUBLE_EQ(next(1.2 * first), 0.6 * first);
}

}  // namespace
}  // namespace culm::analysis
