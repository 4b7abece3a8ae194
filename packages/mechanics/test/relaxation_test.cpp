#include <culm/mechanics/relaxation.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace culm {
namespace {

TEST(MaxwellStep, RelaxesExactlyWhatIsHeld) {
  double d = 1.0;
  for (int i = 0; i < 70; ++i) d *= MaxwellStep::of(0.1, 2.5).kept;
  EXPECT_NEAR(d, std::exp(-7.0 / 2.5), 1e-14);
}

// Creep of a solid with one branch under a stress that is held: e = s (1 - g/(1+g) exp(-t/T)) with
// T = (1 + g) time, after steps of second order.
TEST(MaxwellStep, CreepsWithOrderTwo) {
  const double g = 0.7, time = 1.3, end = 2.0;
  const auto error = [&](int steps) {
    const MaxwellStep step = MaxwellStep::of(end / steps, time);
    double e = 1.0 / (1.0 + g), d = e;  // right after the stress came
    for (int i = 0; i < steps; ++i) {
      // mean of e + g d equal to the stress 1
      const double De = (1.0 - e - g * step.mean_kept * d) / (0.5 + g * step.mean_gained);
      d = step.kept * d + step.gained * De;
      e += De;
    }
    return std::abs(e - (1.0 - g / (1.0 + g) * std::exp(-end / ((1.0 + g) * time))));
  };
  EXPECT_NEAR(std::log2(error(50) / error(100)), 2.0, 0.01);
  EXPECT_LT(error(20000), 1e-8);
}

// Of the steady oscillation e = sin(w t): loss modulus g w T / (1 + w^2 T^2).
TEST(MaxwellStep, TakesTheEnergyOfTheLossModulus) {
  const double time = 0.4, w = 3.0;
  const double expected = std::numbers::pi * w * time / (1.0 + w * w * time * time);
  const auto loss = [&](int steps) {
    const double h = 2.0 * std::numbers::pi / w / steps;
    const MaxwellStep step = MaxwellStep::of(h, time);
    double d = 0.0, taken = 0.0;
    for (int i = 0; i < 8 * steps; ++i) {
      const double De = std::sin(w * h * (i + 1)) - std::sin(w * h * i);
      const double mean = step.mean_kept * d + step.mean_gained * De;
      const double next = step.kept * d + step.gained * De;
      if (i >= 7 * steps) taken += mean * De - 0.5 * (next * next - d * d);
      d = next;
    }
    return taken;
  };
  EXPECT_NEAR(std::log2((loss(40) - expected) / (loss(80) - expected)), 2.0, 0.02);
  EXPECT_NEAR(loss(40000), expected, 1e-8 * expected);
}

TEST(MaxwellStep, NeverGivesEnergy) {
  for (const double x : {1e-9, 1e-4, 0.019, 0.021, 0.5, 3.0, 1e3, 1e12}) {
    const MaxwellStep step = MaxwellStep::of(x, 1.0);
    for (int i = 0; i < 64; ++i) {
      const double angle = 0.1 * i;
      const double d = std::cos(angle), De = std::sin(angle);
      const double next = step.kept * d + step.gained * De;
      const double taken =
          (step.mean_kept * d + step.mean_gained * De) * De - 0.5 * (next * next - d * d);
      EXPECT_GE(taken, -1e-15) << x;
    }
  }
}

TEST(MaxwellStep, SeriesMeetsTheFormula) {
  const double below = MaxwellStep::of(0.02 * (1.0 - 1e-12), 1.0).mean_gained;
  const double above = MaxwellStep::of(0.02 * (1.0 + 1e-12), 1.0).mean_gained;
  EXPECT_NEAR(below, above, 1e-13);
}

}  // namespace
}  // namespace culm
