#include <culm/math/rotation.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace culm {
namespace {

const Vec3 axis = Vec3(0.3, -0.7, 0.5).normalized();

double distance(const Mat3& a, const Mat3& b) { return (a - b).cwiseAbs().maxCoeff(); }

TEST(Skew, GivesTheCrossProduct) {
  const Vec3 a(1.0, -2.0, 3.0);
  const Vec3 b(0.4, 0.5, -0.6);
  EXPECT_EQ(Vec3(skew(a) * b), a.cross(b));
}

TEST(ExpRotation, IsARotationThatKeepsItsAxis) {
  for (const double angle : {0.0, 1e-9, 1e-5, 1e-2, 0.099, 0.101, 0.5, 2.0, 3.1, 6.0, 40.0}) {
    const Mat3 R = exp_rotation(angle * axis);
    EXPECT_LT(triad_defect(R), 1e-15 * (10.0 + angle)) << angle;
    EXPECT_LT((R * axis - axis).norm(), 1e-14) << angle;
    EXPECT_NEAR(R.trace(), 1.0 + 2.0 * std::cos(angle), 2e-14) << angle;
  }
}

TEST(ExpRotation, TurnsFirstToSecondAxisAboutTheThird) {
  const Mat3 R = exp_rotation(std::numbers::pi / 2.0 * Vec3::UnitZ());
  EXPECT_LT((R * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-15);
}

TEST(ExpRotation, DoesNotJumpWhereTheSeriesEnds) {
  const Mat3 below = exp_rotation(0.1 * (1.0 - 1e-15) * axis);
  const Mat3 above = exp_rotation(0.1 * (1.0 + 1e-15) * axis);
  EXPECT_LT(distance(below, above), 2e-15);
}

TEST(LogRotation, InvertsTheExponentialUpToPi) {
  for (const double angle : {1e-3, 0.4, 1.5, 3.0, 3.14159}) {
    const Vec3 theta = angle * axis;
    EXPECT_LT((log_rotation(exp_rotation(theta)) - theta).norm(), 1e-12) << angle;
  }
  EXPECT_EQ(log_rotation(Mat3::Identity()).norm(), 0.0);
}

TEST(LogRotation, IsExactToRoundingOnBothSidesOfTheEndOfTheSeries) {
  for (const double angle : {1e-9, 1e-4, 0.01, 0.05, 0.0999, 0.1002, 0.1003, 0.2}) {
    const Vec3 theta = angle * axis;
    const double there = (log_rotation(exp_rotation(theta)) - theta).norm();
    EXPECT_LT(there, 1e-15) << angle;
    EXPECT_LT((log_rotation(exp_rotation(theta)) + log_rotation(exp_rotation(-theta))).norm(),
              1e-15);
  }
}

TEST(LogRotation, TellsHalfATurnFromNone) {
  EXPECT_NEAR(log_rotation(exp_rotation((std::numbers::pi - 0.01) * axis)).norm(),
              std::numbers::pi - 0.01, 1e-9);
}

TEST(PolarCorrection, SquaresTheDefect) {
  Mat3 D = exp_rotation(Vec3(0.2, 0.9, -0.4));
  D(0, 1) += 1e-5;
  EXPECT_LT(triad_defect(polar_correction(D)), 1e-9);
  EXPECT_LT(triad_defect(polar_correction(polar_correction(D))), 1e-15);
}

TEST(NearestRotation, FindsTheRotationUnderAStretch) {
  const Mat3 R = exp_rotation(Vec3(0.2, 0.9, -0.4));
  const Mat3 stretch = (Mat3() << 1.2, 0.1, 0.0, 0.1, 0.9, 0.05, 0.0, 0.05, 1.0).finished();
  EXPECT_LT(distance(nearest_rotation(R * stretch), R), 1e-14);
}

TEST(NearestRotation, IsNeverAReflection) {
  const Mat3 mirrored = exp_rotation(Vec3(0.2, 0.9, -0.4)) * Vec3(1.0, 1.0, -0.1).asDiagonal();
  EXPECT_NEAR(nearest_rotation(mirrored).determinant(), 1.0, 1e-14);
}

TEST(TriadDefect, TellsLeftHandedTriadsApart) {
  EXPECT_EQ(triad_defect(Mat3::Identity()), 0.0);
  EXPECT_EQ(triad_defect(-Mat3::Identity()), 2.0);
  EXPECT_NEAR(triad_defect(1.01 * Mat3::Identity()), 0.0201, 1e-15);
}

TEST(TriadAlong, HasItsThirdAxisAlongAndItsFirstTowardsUp) {
  const Vec3 up(0.1, 0.2, 1.0);
  const Mat3 D = triad_along(3.0 * axis, up);
  EXPECT_LT(triad_defect(D), 1e-15);
  EXPECT_LT((D.col(2) - axis).norm(), 1e-15);
  EXPECT_NEAR(D.col(1).dot(up), 0.0, 1e-15);
  EXPECT_GT(D.col(0).dot(up), 0.0);
}

TEST(AnyNormal, DoesNotDependOnRounding) {
  const Vec3 along(1.0, 0.0, 0.0);
  for (const double rounding : {1e-17, -1e-17, 1e-9}) {
    EXPECT_LT((any_normal({1.0, rounding, 0.0}) - any_normal(along)).norm(), 1e-8);
    EXPECT_LT((any_normal({1.0, 0.0, rounding}) - any_normal(along)).norm(), 1e-8);
  }
}

TEST(AnyNormal, IsAUnitNormal) {
  for (const Vec3& n : {Vec3(2.0, 0.0, 0.0), Vec3(0.0, -1.0, 0.0), Vec3(0.1, 5.0, -3.0)}) {
    EXPECT_NEAR(any_normal(n).dot(n), 0.0, 1e-15);
    EXPECT_NEAR(any_normal(n).norm(), 1.0, 1e-15);
  }
}

TEST(CayleyVector, IsTwiceTheTangentOfHalfTheAngle) {
  const Mat3 prev = exp_rotation(Vec3(0.2, 0.9, -0.4));
  const double angle = 0.8;
  const Vec3 tau = cayley_vector(prev, exp_rotation(angle * axis) * prev);
  EXPECT_LT((tau - 2.0 * std::tan(angle / 2.0) * axis).norm(), 1e-14);
}

TEST(CayleyVector, MovesEachDirectorThroughItsMean) {
  const Mat3 prev = exp_rotation(Vec3(0.2, 0.9, -0.4));
  const Mat3 next = exp_rotation(Vec3(-1.1, 0.3, 0.7));
  const Vec3 tau = cayley_vector(prev, next);
  for (int i = 0; i < 3; ++i) {
    const Vec3 mean = 0.5 * (prev.col(i) + next.col(i));
    EXPECT_LT((next.col(i) - prev.col(i) - tau.cross(mean)).norm(), 2e-15);
  }
}

}  // namespace
}  // namespace culm
