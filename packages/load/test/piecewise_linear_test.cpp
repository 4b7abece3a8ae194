#include <culm/load/piecewise_linear.hpp>

#include <gtest/gtest.h>

namespace culm::load {
namespace {

// Slopes 2, 0.5, -1; at 0 the value is 1.5: no symmetry, and not through the origin.
PiecewiseLinear kinked() { return {{-1.0, 0.5, 2.0, 3.0}, {-0.5, 2.5, 3.25, 2.25}}; }

TEST(PiecewiseLinear, IsLinearBetweenItsPointsAndGoesOnBeyondThem) {
  const PiecewiseLinear f = kinked();
  EXPECT_DOUBLE_EQ(f.value(0.0), 1.5);
  EXPECT_DOUBLE_EQ(f.value(0.5), 2.5);
  EXPECT_DOUBLE_EQ(f.value(1.0), 2.75);
  EXPECT_DOUBLE_EQ(f.value(-3.0), -4.5);
  EXPECT_DOUBLE_EQ(f.value(5.0), 0.25);
  EXPECT_DOUBLE_EQ(f.slope(-3.0), 2.0);
  EXPECT_DOUBLE_EQ(f.slope(1.0), 0.5);
  EXPECT_DOUBLE_EQ(f.slope(5.0), -1.0);
}

TEST(PiecewiseLinear, MeanTimesLengthIsTheIncrementOfTheIntegral) {
  const PiecewiseLinear f = kinked();
  for (double a : {-2.0, -0.3, 0.5, 1.1, 2.5, 4.0}) {
    for (double b : {-2.5, -1.0, 0.2, 0.5, 1.9, 3.7}) {
      EXPECT_NEAR(f.mean(a, b).value * (b - a), f.integral(b) - f.integral(a), 1e-14);
    }
  }
  EXPECT_NEAR(f.integral(0.5), 1.0, 1e-15);  // 1.5 x 0.5 + 2 x 0.5^2 / 2
}

TEST(PiecewiseLinear, DerivativeOfTheMeanIsItsSlopeByTheEnd) {
  const PiecewiseLinear f = kinked();
  const double h = 1e-4;  // the mean is rational in b; its third derivative is below 10
  for (double a : {-2.0, -0.3, 1.1, 4.0}) {
    for (double b : {-2.5, 0.2, 1.3, 3.7}) {
      const double difference = (f.mean(a, b + h).value - f.mean(a, b - h).value) / (2.0 * h);
      EXPECT_NEAR(f.mean(a, b).derivative, difference, 2e-7) << a << " to " << b;
    }
  }
}

// DF / Du of a step that ends a hair beyond a kink would lose all digits.
TEST(PiecewiseLinear, MeanOfATinyIntervalAcrossAKinkKeepsItsDigits) {
  const PiecewiseLinear f = kinked();
  const PiecewiseLinear::Mean mean = f.mean(0.5 - 1e-13, 0.5 + 1e-13);
  EXPECT_NEAR(mean.value, 2.5, 1e-12);
  EXPECT_NEAR(mean.derivative, 0.125 * 2.0 + 0.375 * 0.5, 1e-3);  // weights of both slopes
  EXPECT_DOUBLE_EQ(f.mean(1.0, 1.0).value, 2.75);
  EXPECT_DOUBLE_EQ(f.mean(1.0, 1.0).derivative, 0.25);
}

TEST(PiecewiseLinear, ProportionalHasNoKink) {
  const PiecewiseLinear f = PiecewiseLinear::proportional(-3.0);
  EXPECT_DOUBLE_EQ(f.value(-2.0), 6.0);
  EXPECT_DOUBLE_EQ(f.integral(-2.0), -6.0);
  EXPECT_DOUBLE_EQ(f.mean(-1.0, 4.0).value, -4.5);
}

TEST(PiecewiseLinear, PointsMustRise) {
  EXPECT_EQ(PiecewiseLinear::mistake({0.0, 1.0}, {2.0, 2.0}), "");
  EXPECT_EQ(PiecewiseLinear::mistake({0.0, 1.0, 1.0}, {2.0, 2.0, 3.0}),
            "must increase, got 1 before 1");
  EXPECT_EQ(PiecewiseLinear::mistake({0.0}, {2.0}),
            "needs as many points as values, and two at least, got 1 and 1");
}

}  // namespace
}  // namespace culm::load
