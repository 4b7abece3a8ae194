#include <culm/analysis/predictor.hpp>

#include "motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace culm::analysis {
namespace {

// Steps of a top with a predictor that learns; the first guess of each step is compared with its
// end.
class Predicted {
 public:
  explicit Predicted(double h) : h_(h), predictor(*top.system) {}

  // largest motion from the guess to the solution
  double step() {
    model::State guess = top.state;
    predictor.predict(guess, h_);
    if (!top.attempt(h_).accepted) throw std::runtime_error("a step did not converge");
    guess.prev = guess.next;
    guess.next = top.state.next;
    double error = 0.0;
    assembly::System::Motions motions(top.system->num_motions());
    top.system->motions(guess, 0, motions);
    for (const Vec6& motion : motions) {
      error = std::max(error, motion.lpNorm<Eigen::Infinity>());
    }
    predictor.accept(top.state, h_);
    top.stepper->accept();
    return top.comm.max(error);
  }

 private:
  double h_;

 public:
  Motion top{build_top};
  Predictor predictor;
};

TEST(Predictor, BeginsWithTheVelocityOfTheStart) {
  Predicted run(1e-3);
  EXPECT_EQ(run.predictor.points(), 0);
  const double error = run.step();
  Predicted half(0.5e-3);
  EXPECT_NEAR(error / half.step(), 4.0, 0.4);  // h^2 / 2 times the acceleration
}

// Stiff vibrations that steps do not resolve change the sign of velocities in every step; what the
// steps moved does not.
TEST(Predictor, DoesNotTakeVelocitiesThatJump) {
  Predicted run(1e-3);
  for (int k = 0; k < 3; ++k) run.step();
  EXPECT_GT(run.predictor.reversal(), 0.0);
  for (int k = 0; k < 6; ++k) {
    ASSERT_TRUE(run.top.attempt(1e-3).accepted);
    model::State jumping = run.top.state;
    for (double& v : jumping.velocity) v *= k % 2 == 0 ? 6.0 : -4.0;
    run.predictor.accept(jumping, 1e-3);
    run.top.stepper->accept();
  }
  EXPECT_LT(run.predictor.reversal(), -0.5);
  run.predictor.reject();
  EXPECT_EQ(run.predictor.points(), 2);
  model::State one = run.top.state;
  model::State two = run.top.state;
  for (double& v : two.velocity) v = -v;
  run.predictor.predict(one, 1e-3);
  run.predictor.predict(two, 1e-3);
  EXPECT_TRUE(std::ranges::equal(one.next, two.next));
}

TEST(Predictor, MeetsASmoothMotionByAPolynomial) {
  double errors[2] = {};
  for (int i = 0; i < 2; ++i) {
    Predicted run(1e-3 / (i + 1));
    for (int k = 0; k < 8 * (i + 1); ++k) errors[i] = run.step();
    EXPECT_GE(run.predictor.points(), 3);
  }
  EXPECT_GE(std::log2(errors[0] / errors[1]), 3.8);  // h^4 with three points
}

TEST(Predictor, GoesOnAsBeforeFromACheckpoint) {
  Predicted run(1e-3);
  for (int k = 0; k < 3; ++k) run.step();
  Snapshot snapshot;
  run.predictor.save(snapshot);
  Predictor other(*run.top.system);
  other.restore(snapshot);
  model::State one = run.top.state;
  model::State two = run.top.state;
  run.predictor.predict(one, 1e-3);
  other.predict(two, 1e-3);
  EXPECT_TRUE(std::ranges::equal(one.next, two.next));
  EXPECT_EQ(run.predictor.points(), other.points());
}

}  // namespace
}  // namespace culm::analysis
