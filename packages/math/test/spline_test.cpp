#include <culm/math/spline.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace culm {
namespace {

std::vector<Vec3> quarter_circle(int pieces) {
  std::vector<Vec3> points;
  for (int i = 0; i <= pieces; ++i) {
    const double phi = 0.5 * std::numbers::pi * i / pieces;
    points.emplace_back(2.0 * std::cos(phi), 2.0 * std::sin(phi), 0.0);
  }
  return points;
}

TEST(Spline, IsALineThroughTwoPoints) {
  const Spline line({Vec3(1.0, 0.0, 0.0), Vec3(1.0, 3.0, 4.0)});
  EXPECT_DOUBLE_EQ(line.length(), 5.0);
  EXPECT_LT((line.position(2.0) - Vec3(1.0, 1.2, 1.6)).norm(), 1e-15);
  EXPECT_LT((line.tangent(2.0) - Vec3(0.0, 0.6, 0.8)).norm(), 1e-15);
}

TEST(Spline, MeetsItsPointsAtTheirArcLengths) {
  const std::vector<Vec3> points{Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.5, 0.0), Vec3(1.5, 2.0, 1.0),
                                 Vec3(4.0, 2.0, 1.5)};
  const Spline curve(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT((curve.position(curve.arc_lengths()[i]) - points[i]).norm(), 1e-13);
  }
}

// The parameter is arc length: also across points, where slope and curvature are continuous.
TEST(Spline, TangentIsTheDerivativeOfPosition) {
  const Spline curve(
      {Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.5, 0.0), Vec3(1.5, 2.0, 1.0), Vec3(4.0, 2.0, 1.5)});
  const double step = 1e-5;
  for (int i = 1; i < 40; ++i) {
    const double s = curve.length() * i / 40.0;
    const Vec3 slope = (curve.position(s + step) - curve.position(s - step)) / (2.0 * step);
    EXPECT_LT((slope - curve.tangent(s)).norm(), 1e-8);
  }
}

// Curvature that vanishes at the ends costs order two there; inside the spline is of order four.
TEST(Spline, ConvergesToACircle) {
  double before = 0.0;
  for (const int pieces : {8, 16, 32}) {
    const Spline curve(quarter_circle(pieces));
    const Vec3 inside = curve.position(0.47 * curve.length());
    const double error = std::abs(inside.norm() - 2.0);
    if (before > 0.0) {
      EXPECT_LT(error, before / 8.0);
    }
    before = error;
  }
  EXPECT_NEAR(Spline(quarter_circle(64)).length(), std::numbers::pi, 1e-5);
}

}  // namespace
}  // namespace culm
