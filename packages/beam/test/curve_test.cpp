#include <culm/beam/curve.hpp>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace culm::beam {
namespace {

using std::numbers::pi;

// The tangent is the derivative of the position, and has unit length: s is arc length.
void expect_arc_length(const Curve& curve) {
  const double step = 1e-5 * curve.length;
  for (int i = 1; i < 10; ++i) {
    const double s = curve.length * i / 10.0;
    const Vec3 slope = (curve.position(s + step) - curve.position(s - step)) / (2.0 * step);
    EXPECT_LT((slope - curve.tangent(s)).norm(), 1e-8);
    EXPECT_NEAR(curve.tangent(s).norm(), 1.0, 1e-14);
  }
}

TEST(Line, RunsFromPointToPoint) {
  const Vec3 from(1.0, 2.0, 3.0);
  const Vec3 to(1.0, 5.0, 7.0);
  const Curve curve = line(from, to);
  EXPECT_EQ(curve.length, 5.0);
  EXPECT_LT((curve.position(5.0) - to).norm(), 1e-15);
  EXPECT_NEAR(curve.normal.dot(to - from), 0.0, 1e-15);
  expect_arc_length(curve);
}

TEST(Helix, IsAnArcWithoutPitch) {
  const Curve curve =
      helix(Vec3(0.0, 0.0, 9.0), Vec3(0.0, 0.0, 2.0), Vec3(2.0, 0.0, 1.0), pi / 2.0, 0.0);
  EXPECT_NEAR(curve.length, pi, 1e-15);
  EXPECT_LT((curve.position(curve.length) - Vec3(0.0, 2.0, 1.0)).norm(), 1e-15);
  EXPECT_LT((curve.tangent(0.0) - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_EQ(curve.normal, Vec3(Vec3::UnitZ()));
  expect_arc_length(curve);
}

TEST(Helix, AdvancesByItsPitchPerTurn) {
  const Curve curve = helix(Vec3::Zero(), Vec3::UnitZ(), Vec3(1.0, 0.0, 0.0), 2.0 * 2.0 * pi, 0.5);
  EXPECT_NEAR(curve.length, 4.0 * pi * std::hypot(1.0, 0.5 / (2.0 * pi)), 1e-14);
  EXPECT_LT((curve.position(curve.length) - Vec3(1.0, 0.0, 1.0)).norm(), 1e-14);
  expect_arc_length(curve);
}

TEST(Helix, RunsBackwardsForNegativeAngles) {
  const Curve curve = helix(Vec3::Zero(), Vec3::UnitZ(), Vec3(1.0, 0.0, 0.0), -2.0 * pi, 0.5);
  EXPECT_LT((curve.position(curve.length) - Vec3(1.0, 0.0, -0.5)).norm(), 1e-14);
  EXPECT_LT(curve.tangent(0.0).y(), 0.0);
  expect_arc_length(curve);
}

TEST(ArcThrough, MeetsItsPointsInOrder) {
  const Vec3 a(1.0, 0.3, -0.2);
  const Vec3 b(0.1, 1.2, 0.4);
  const Vec3 c(-0.8, -0.5, 0.3);
  const Curve curve = arc_through(a, b, c);
  EXPECT_LT((curve.position(0.0) - a).norm(), 1e-14);
  EXPECT_LT((curve.position(curve.length) - c).norm(), 1e-14);
  // b lies on it: the distance to b comes to nothing somewhere on the way
  double nearest = 1.0;
  for (int i = 0; i <= 10000; ++i) {
    nearest = std::min(nearest, (curve.position(curve.length * i / 10000.0) - b).norm());
  }
  EXPECT_LT(nearest, curve.length / 10000.0);
  expect_arc_length(curve);
}

TEST(ArcThrough, CanBeMoreThanHalfACircle) {
  const Curve curve = arc_through(Vec3(1.0, 0.0, 0.0), Vec3(-1.0, 0.0, 0.0), Vec3(0.0, -1.0, 0.0));
  EXPECT_NEAR(curve.length, 1.5 * pi, 1e-14);
}

}  // namespace
}  // namespace culm::beam
