#include <culm/joint/rigid_support.hpp>
#include <culm/joint/rotation.hpp>
#include <culm/joint/simple_support.hpp>
#include <culm/joint/simple_support_local.hpp>
#include <culm/math/rotation.hpp>

#include <Eigen/Geometry>
#include <culm_kit/dense_assembly.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace culm::joint {
namespace {

using kit::oblique;

// Amount times t: a motion that is not a ramp, so that times beyond 1 tell.
Prescribed proportional(double amount) {
  return {amount, model::Amplitude::of_time([](double t) { return t; })};
}

class DrivenSupport : public testing::Test {
 protected:
  const model::NodeSlots reference = kit::random_node(1);
  model::NodeTable nodes;
  DrivenSupport() { nodes.add(reference); }

  /// The value of the only row of a support at a time.
  static double row(model::Constraint support, double time, const model::NodeSlots& q) {
    if (support.drive) support.drive(time, support.rows);
    const model::ConstraintRow& row = support.rows.front();
    const Eigen::Vector4d alpha(row.alpha.data());
    Vec3 second = row.direction;
    if (!row.linear()) second += q * Eigen::Vector4d(row.beta.data());
    return (q * alpha).dot(second) - row.constant;
  }
  model::NodeSlots turned(const Vec3& rotation) const {
    model::NodeSlots q = reference;
    q.rightCols<3>() = exp_rotation(rotation) * reference.rightCols<3>();
    return q;
  }
};

constexpr double round_off_of_a_row = 1e-15;

TEST_F(DrivenSupport, RotationRowsVanishAfterTheExactRotation) {
  for (double time : {0.0, 0.4, 1.0, 2.5, -1.3}) {
    const model::NodeSlots q = turned(2.0 * time * oblique);
    EXPECT_LT(std::abs(row(rotation({nodes, 0}, oblique, proportional(2.0)), time, q)),
              round_off_of_a_row);
    EXPECT_LT(std::abs(row(rotation_local({nodes, 0}, oblique, proportional(2.0)), time, q)),
              round_off_of_a_row);
  }
}

TEST_F(DrivenSupport, RotationRowsMeasureTheAngleThatIsMissing) {
  const model::NodeSlots q = turned(0.9 * oblique);
  const double missing = 0.3;
  // a body vector of length one, in the plane of rotation
  EXPECT_NEAR(row(rotation({nodes, 0}, oblique, proportional(0.9 - missing)), 1.0, q),
              std::sin(missing), round_off_of_a_row);
  EXPECT_NEAR(row(rotation_local({nodes, 0}, oblique, proportional(0.9 - missing)), 1.0, q),
              -std::sin(missing), round_off_of_a_row);
}

TEST_F(DrivenSupport, RotationLeavesRotationsAcrossTheDrivenVectorFree) {
  const Vec3 c0 = any_normal(oblique);
  // the plane of oblique and c0 is where the row does not look
  model::NodeTable aligned;
  model::NodeSlots q = model::NodeSlots::Zero();
  q.rightCols<3>() << oblique, c0, oblique.cross(c0);
  aligned.add(q);
  const model::Constraint support = rotation({aligned, 0}, oblique, proportional(0.0));
  const Mat3 triad = q.rightCols<3>();
  for (const Vec3& free : {c0, Vec3(oblique.cross(c0))}) {
    q.rightCols<3>() = exp_rotation(0.7 * free) * triad;
    EXPECT_LT(std::abs(row(support, 0.0, q)), round_off_of_a_row);
  }
  q.rightCols<3>() = exp_rotation(0.7 * oblique) * triad;
  EXPECT_NEAR(row(support, 0.0, q), std::sin(0.7), round_off_of_a_row);
}

TEST_F(DrivenSupport, SimpleSupportsFollowTheirTranslation) {
  model::NodeSlots q = reference;
  q.col(0) += 0.75 * oblique + 2.0 * any_normal(oblique);
  EXPECT_NEAR(row(simple_support({nodes, 0}, oblique, Vec3::Zero(), proportional(0.5)), 1.5, q),
              0.0, round_off_of_a_row);
  EXPECT_NEAR(row(simple_support_local({nodes, 0}, oblique, proportional(0.5)), 1.5, q), 0.0,
              round_off_of_a_row);
}

TEST_F(DrivenSupport, RigidSupportsFollowTheirMotion) {
  const Translation translation{Vec3(0.3, -0.2, 0.5),
                                model::Amplitude::of_time([](double t) { return t * t; })};
  const SupportMotion motion{translation, oblique, proportional(0.4)};
  const double time = 1.5;
  model::NodeSlots q = turned(0.6 * oblique);
  q.col(0) += 2.25 * translation.amount;
  model::Constraint support = rigid_support({nodes, 0}, motion);
  support.drive(time, support.rows);
  ASSERT_EQ(support.rows.size(), 6U);
  for (const model::ConstraintRow& r : support.rows) {
    EXPECT_NEAR(model::row_value(r, q), 0.0, round_off_of_a_row);
  }
  EXPECT_FALSE(support.fix);
  EXPECT_TRUE(rigid_support({nodes, 0}).fix);  // at rest it is eliminated
}

TEST_F(DrivenSupport, RigidSupportsCircleAPoint) {
  const Vec3 about(0.7, -1.1, 0.4);
  const Mat3 turn = exp_rotation(0.6 * oblique);
  model::NodeSlots q = turned(0.6 * oblique);
  q.col(0) = about + turn * (reference.col(0) - about);
  model::Constraint support = rigid_support({nodes, 0}, {{}, oblique, proportional(0.4), about});
  support.drive(1.5, support.rows);
  for (const model::ConstraintRow& r : support.rows) {
    EXPECT_NEAR(model::row_value(r, q), 0.0, round_off_of_a_row);
  }
}

TEST_F(DrivenSupport, OnlyTheLocalDirectionTurnsWithTheNode) {
  const Vec3 turn(0.3, 0.9, -0.4);
  model::NodeSlots q = turned(turn);
  const Vec3 away(0.2, 0.5, -0.7);
  q.col(0) += away;
  EXPECT_NEAR(row(simple_support({nodes, 0}, oblique, Vec3::Zero()), 0.0, q), oblique.dot(away),
              round_off_of_a_row);
  EXPECT_NEAR(row(simple_support_local({nodes, 0}, oblique), 0.0, q),
              (exp_rotation(turn) * oblique).dot(away), round_off_of_a_row);
}

// The rows hold half a turn away; what tells the turns apart does not.
TEST_F(DrivenSupport, TurnsAreToldFromThoseThatMeetTheSameRows) {
  const Vec3 across = any_normal(oblique);
  for (const double angle : {0.0, 1.0, 3.0, -2.0, 9.0}) {
    for (const double missing : {0.0, 0.4, -1.2, std::numbers::pi}) {
      const Eigen::Matrix3Xd q = turned((angle - missing) * oblique);
      const double expected = std::abs(std::remainder(missing, 2.0 * std::numbers::pi));
      for (const model::Constraint& support :
           {rotation({nodes, 0}, oblique, proportional(1.0)),
            rotation_local({nodes, 0}, oblique, proportional(1.0)),
            rigid_support({nodes, 0}, {{}, oblique, proportional(1.0), {}})}) {
        EXPECT_NEAR(support.turn->off(angle, q), expected, 1e-7) << angle << ' ' << missing;
      }
    }
  }
  const model::Constraint free = rotation({nodes, 0}, oblique, proportional(1.0));
  // rotations across leave the angle about the axis, as long as the axis does not turn round
  for (const double tilt : {0.5, 1.5}) {
    model::NodeSlots q = turned(0.7 * oblique);
    q.rightCols<3>() = (exp_rotation(tilt * across) * q.rightCols<3>()).eval();
    EXPECT_NEAR(free.turn->off(0.7, q), 0.0, 1e-12);
    EXPECT_NEAR(free.turn->off(0.2, q), 0.5, 1e-12);
  }
  EXPECT_EQ(free.turn->off(3.0, turned(3.0 * across)), 0.0);
}

TEST_F(DrivenSupport, OnlyWhatTurnsHasATurn) {
  EXPECT_FALSE(rotation({nodes, 0}, oblique, {}).turn);
  EXPECT_FALSE(rigid_support({nodes, 0}, {{Vec3(1, 0, 0)}, oblique, {}, {}}).turn);
  model::State state;
  state.time_prev = 0.5;
  state.time = 2.0;
  const model::Constraint support = rotation({nodes, 0}, oblique, proportional(3.0));
  EXPECT_EQ(support.turn->prescribed(state, 0.0), 1.5);
  EXPECT_EQ(support.turn->prescribed(state, 1.0), 6.0);
}

}  // namespace
}  // namespace culm::joint
