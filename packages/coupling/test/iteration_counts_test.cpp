// How many attempts schemes need where a fluid is heavier than the wall over it.
#include <culm/coupling/channel_flow.hpp>
#include <culm/coupling/parts.hpp>
#include <culm/coupling/scheme.hpp>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace culm::coupling {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int string_points = 40;
constexpr double spacing = 1.0 / (string_points + 1);
constexpr double step = 2e-3;
constexpr double never = std::numeric_limits<double>::infinity();

// What moves the string: a push, or its shape at the start; its springs, and the water under it.
struct Motion {
  double push = 5.0;
  bool even = false;  // pushed alike everywhere, else most near its middle
  double first_wave = 0.0, third_wave = 0.0;
  double hardening = 1e6;
  double depth = 0.02;
};

// A string of unit tension on springs that harden by the cube, by the mid-point rule, and what the
// channel under it answers to a step.
class StringOverChannel {
 public:
  // @param ratio  mass of each point of the string over the largest one of the fluid
  explicit StringOverChannel(double ratio, const Motion& motion = {})
      : ratio_(ratio), motion_(motion) {
    using std::numbers::pi;
    const auto x = Eigen::ArrayXd::LinSpaced(string_points, spacing, 1.0 - spacing);
    place_ = motion.first_wave * (pi * x).sin() + motion.third_wave * (3.0 * pi * x).sin();
    FlowChannel channel = {1.0, motion.depth, 1.0, Eigen::Vector3d::UnitZ()};
    const MatrixXd masses = channel_masses(channel, string_points, spacing);
    channel.density = 1.0 / masses.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff();
    fluid_ = make_channel_flow(channel);
    VectorXd reference = VectorXd::Zero(3 * string_points);
    for (int i = 0; i < string_points; ++i) reference[3 * i] = (i + 1) * spacing;
    fluid_->begin(reference, VectorXd::Zero(3 * string_points));
    tension_ = MatrixXd::Zero(string_points, string_points);
    tension_.diagonal().setConstant(2.0 / (spacing * spacing));
    tension_.diagonal(1).setConstant(-1.0 / (spacing * spacing));
    tension_.diagonal(-1).setConstant(-1.0 / (spacing * spacing));
  }

  // The step that the string makes with these forces.
  VectorXd move(const VectorXd& forces) { return moved_ = solve(forces); }
  VectorXd answer(const VectorXd& moved) const {
    return along_z(fluid_->forces(in_space(moved), step));
  }
  VectorXd operator()(const VectorXd& forces) { return answer(move(forces)); }
  const VectorXd& place() const { return place_; }
  // Motion of the next step if the string goes on as it is.
  VectorXd foreseen() const { return step * velocity_; }
  void accept() {
    fluid_->accept(in_space(moved_), step);
    velocity_ = 2.0 / step * moved_ - velocity_;
    place_ += moved_;
    time_ += step;
  }

 private:
  VectorXd solve(const VectorXd& forces) const {
    const double hardening = motion_.hardening;
    const VectorXd x = VectorXd::LinSpaced(string_points, spacing, 1.0 - spacing);
    VectorXd load =
        VectorXd::Constant(string_points, motion_.push * std::sin(40.0 * (time_ + 0.5 * step)));
    if (!motion_.even) load.array() *= x.array() * (1.0 - x.array()) * (1.0 + 0.2 * x.array());
    VectorXd moved = step * velocity_;
    for (int i = 0; i < 30; ++i) {
      const VectorXd middle = place_ + 0.5 * moved;
      const VectorXd residual = 2.0 * ratio_ / step * (moved / step - velocity_) +
                                tension_ * middle + hardening * middle.array().cube().matrix() -
                                forces - load;
      MatrixXd tangent = 0.5 * tension_;
      tangent.diagonal().array() +=
          2.0 * ratio_ / (step * step) + 1.5 * hardening * middle.array().square();
      const VectorXd change = tangent.llt().solve(-residual);
      moved += change;
      if (change.norm() < 1e-14 * moved.norm()) break;
    }
    return moved;
  }
  static VectorXd in_space(const VectorXd& z) {
    VectorXd all = VectorXd::Zero(3 * string_points);
    all.reshaped(3, string_points).row(2) = z;
    return all;
  }
  static VectorXd along_z(const VectorXd& all) { return all.reshaped(3, string_points).row(2); }

  double ratio_;
  Motion motion_;
  std::unique_ptr<PointModel> fluid_;
  MatrixXd tension_;
  VectorXd place_ = VectorXd::Zero(string_points), velocity_ = place_, moved_ = place_;
  double time_ = 0.0;
};

// Mean attempts of 60 windows but the first five.
double mean_attempts(double ratio, Scheme& scheme, double tolerance) {
  constexpr int windows = 60, first = 5, most = 200;
  StringOverChannel model(ratio);
  VectorXd forces = VectorXd::Zero(string_points);
  int sum = 0;
  for (int window = 0; window < windows; ++window) {
    VectorXd answer = model(forces);
    int tried = 1;
    for (; (answer - forces).norm() > tolerance * answer.norm() + 1e-16; ++tried) {
      if (tried == most) return never;
      forces = scheme.next(forces, answer);
      answer = model(forces);
    }
    scheme.end_window();
    model.accept();
    forces = answer;
    if (window >= first) sum += tried;
  }
  return static_cast<double>(sum) / (windows - first);
}

// The same where the place of the string is iterated, by a scheme that begins anew in each window:
// from the place that its velocity foresees, or from the last one.
template <class Relaxation>
double attempts_of_places(double ratio, const Motion& motion, double factor, bool foresee,
                          double tolerance) {
  constexpr int windows = 60, first = 5, most = 200;
  StringOverChannel model(ratio, motion);
  int sum = 0;
  for (int window = 0; window < windows; ++window) {
    Relaxation scheme(factor);
    VectorXd moved = foresee ? model.foreseen() : VectorXd::Zero(string_points);
    VectorXd answer = model.move(model.answer(moved));
    int tried = 1;
    for (; (answer - moved).norm() > tolerance * (model.place() + answer).norm(); ++tried) {
      if (tried == most) return never;
      moved = scheme.next(moved, answer);
      answer = model.move(model.answer(moved));
    }
    model.accept();
    if (window >= first) sum += tried;
  }
  return static_cast<double>(sum) / (windows - first);
}

// The same where string and fluid begin each attempt together, from forces and a motion.
double mean_parallel_attempts(double ratio, Scheme& scheme, double tolerance) {
  constexpr int windows = 60, first = 5, most = 200;
  StringOverChannel model(ratio);
  PartScale scale;
  VectorXd forces = VectorXd::Zero(string_points);
  int sum = 0;
  for (int window = 0; window < windows; ++window) {
    std::vector<VectorXd> tried = {forces, model.foreseen()}, found;
    const auto fits = [&](std::size_t part) {
      return (found[part] - tried[part]).norm() <= tolerance * found[part].norm() + 1e-16;
    };
    for (int attempt = 1;; ++attempt) {
      found = {model.answer(tried[1]), model.move(tried[0])};
      if (fits(0) && fits(1)) {
        if (window >= first) sum += attempt;
        break;
      }
      if (attempt == most) return never;
      tried = scale.next(scheme, tried, found);
    }
    scheme.end_window();
    scale.end_window();
    model.accept();
    forces = found[0];
  }
  return static_cast<double>(sum) / (windows - first);
}

constexpr std::array ratios = {10.0, 2.0, 1.0, 0.3, 0.1, 0.01};
using Counts = std::array<double, ratios.size()>;

Counts quasi_newton(int reuse, double tolerance) {
  Counts counts = {};
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    QuasiNewton scheme(0.1, reuse, 1e-2);
    counts[i] = mean_attempts(ratios[i], scheme, tolerance);
  }
  return counts;
}

Counts aitken(double tolerance) {
  Counts counts = {};
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    Aitken scheme(0.1);
    counts[i] = mean_attempts(ratios[i], scheme, tolerance);
  }
  return counts;
}

// Keeps them for who runs the test with --gtest_output.
void note(const Counts& counts, const std::string& what) {
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    testing::Test::RecordProperty(fmt::format("{}, mass ratio {}", what, ratios[i]),
                                  fmt::format("{:.1f}", counts[i]));
  }
}

void expect_near(const Counts& found, const Counts& expected, const std::string& what) {
  note(found, what);
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    if (expected[i] == never) {
      EXPECT_EQ(found[i], never) << what << ", mass ratio " << ratios[i];
    } else {
      EXPECT_NEAR(found[i], expected[i], 1.0) << what << ", mass ratio " << ratios[i];
    }
  }
}

// The expected counts are those of an independent program for the same kind of problem: another
// load, the displacement as the unknown.
TEST(IterationCounts, OfQuasiNewtonAreAsExpected) {
  expect_near(quasi_newton(0, 1e-8), {4.1, 4.9, 5.2, 6.5, 8.7, 15.4}, "no reuse");
  expect_near(quasi_newton(5, 1e-8), {2.7, 2.9, 3.1, 3.5, 4.4, 7.5}, "five windows");
  expect_near(quasi_newton(15, 1e-8), {2.4, 2.6, 2.8, 2.9, 3.3, 4.5}, "fifteen windows");
  expect_near(quasi_newton(5, 1e-4), {2.1, 2.2, 2.3, 2.4, 2.6, 4.3}, "tolerance 1e-4");
}

// Both sides at once: what one learns of the other comes an attempt later.
TEST(IterationCounts, OfParallelQuasiNewtonAreLittleMoreThanOfASerialOne) {
  Counts parallel = {};
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    QuasiNewton scheme(0.1, 15, 1e-2);
    parallel[i] = mean_parallel_attempts(ratios[i], scheme, 1e-8);
  }
  note(parallel, "parallel, fifteen windows");
  Counts aitken = {};
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    Aitken scheme(0.1);
    aitken[i] = mean_parallel_attempts(ratios[i], scheme, 1e-8);
  }
  note(aitken, "parallel, Aitken");
  const Counts serial = quasi_newton(15, 1e-8);
  for (std::size_t i = 0; i < ratios.size(); ++i)
    EXPECT_LT(parallel[i], serial[i] + 2.0) << ratios[i];
}

// Those of the other program, whose string is let go from a shape.
TEST(IterationCounts, OfAitkenAreAsExpected) {
  const Motion motion = {.push = 0.0, .first_wave = 0.1, .third_wave = 0.03, .hardening = 1e3};
  Counts fine = {}, coarse = {};
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    fine[i] = attempts_of_places<Aitken>(ratios[i], motion, 0.5, false, 1e-8);
    coarse[i] = attempts_of_places<Aitken>(ratios[i], motion, 0.5, false, 1e-4);
  }
  expect_near(fine, {5.5, 7.7, 6.4, 11.8, 13.9, 33.9}, "places, Aitken");
  expect_near(coarse, {3.1, 3.5, 3.6, 5.6, 6.3, 14.3}, "places, Aitken, tolerance 1e-4");
}

// Those of the other program: a string that is pushed alike everywhere, over deep water.
TEST(IterationCounts, OfAConstantFactorAreAsExpected) {
  const Motion motion = {.push = 1.0, .even = true, .depth = 1.0};
  Counts constant = {}, none = {};
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    constant[i] = attempts_of_places<ConstantRelaxation>(ratios[i], motion, 0.1, true, 1e-8);
    none[i] = attempts_of_places<ConstantRelaxation>(ratios[i], motion, 1.0, true, 1e-8);
  }
  expect_near(constant, {107.0, 103.0, 100.0, 89.0, 69.0, never}, "constant factor 0.1");
  expect_near(none, {6.6, 19.0, never, never, never, never}, "no relaxation");
}

// One factor serves all waves of the string, where quasi-Newton has one for each that it has met.
TEST(IterationCounts, OfAitkenGrowAsTheFluidGetsHeavier) {
  const Counts counts = aitken(1e-8), best = quasi_newton(5, 1e-8);
  note(counts, "Aitken");
  EXPECT_TRUE(std::is_sorted(counts.begin(), counts.end()));
  for (const std::size_t i : {4U, 5U}) EXPECT_LT(3.0 * best[i], counts[i]) << ratios[i];
}

// Without relaxation nothing holds from equal masses on, and a constant factor of 0.1 holds below
// 20 times the mass: 2 / 0.1 = 1 + 19.
TEST(IterationCounts, OfAConstantFactorEndAtItsLimit) {
  const auto constant = [](double factor, double ratio) {
    ConstantRelaxation scheme(factor);
    return mean_attempts(ratio, scheme, 1e-8);
  };
  EXPECT_LT(constant(1.0, 2.0), 30.0);
  EXPECT_EQ(constant(1.0, 0.95), never);
  EXPECT_LT(constant(0.1, 1.0 / 16.0), 200.0);
  EXPECT_EQ(constant(0.1, 1.0 / 20.0), never);
}

}  // namespace
}  // namespace culm::coupling
