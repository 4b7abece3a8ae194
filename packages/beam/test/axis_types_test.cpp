#include <culm/base/error.hpp>
#include <culm/beam/axis_types.hpp>
#include <culm/math/rotation.hpp>

#include <Eigen/Geometry>
#include <culm_kit/deck_list.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace culm::beam {
namespace {

using kit::GivenValues;
using Messages = std::vector<std::string>;
using Numbers = std::vector<double>;

class AxisTypes : public testing::Test {
 protected:
  AxisTypes() { register_axes(registry_); }

  Axis make(const std::string& type, const GivenValues& given, int order = 1,
            int refinement = 1) const {
    const Schema schema = registry_.variants().at(type);
    const Options options = kit::deck_list(schema, given);
    EXPECT_EQ(kit::mistakes_in(schema, options), Messages{});
    return registry_.make(type, options, Density{order, refinement});
  }
  Messages mistakes(const std::string& type, const GivenValues& given) const {
    const Schema schema = registry_.variants().at(type);
    return kit::mistakes_in(schema, kit::deck_list(schema, given));
  }
  std::string failure(const std::string& type, const GivenValues& given, int order = 1) const {
    try {
      make(type, given, order);
    } catch (const InputError& error) {
      return error.issues().at(0).message;
    }
    return "no error";
  }

  AxisRegistry registry_;
};

const GivenValues two_metres{{"From", Numbers{0, 0, 0}}, {"To", Numbers{2, 0, 0}}, {"Elements", 4}};

GivenValues with(GivenValues values, const GivenValues& more) {
  values.insert(values.end(), more.begin(), more.end());
  return values;
}

TEST_F(AxisTypes, LineHasEquidistantNodesAndOneTriad) {
  const Axis axis = make("Line", with(two_metres, {{"Up", Numbers{1, 0, 3}}}), 2);
  ASSERT_EQ(axis.chains.size(), 1U);
  const Chain& chain = axis.chains[0];
  ASSERT_EQ(chain.size(), 9U);
  EXPECT_LT((chain[3].position - Vec3(0.75, 0.0, 0.0)).norm(), 1e-15);
  EXPECT_NEAR(chain[3].span, 0.375, 1e-15);
  for (const AxisNode& node : chain) {
    EXPECT_LT((node.triad.col(0) - Vec3::UnitZ()).norm(), 1e-15);
    EXPECT_LT((node.triad.col(2) - Vec3::UnitX()).norm(), 1e-15);
    EXPECT_LT(triad_defect(node.triad), 1e-15);
  }
}

TEST_F(AxisTypes, PreTwistTurnsTheSectionFromFirstToSecondDirector) {
  const Axis axis = make("Line", with(two_metres, {{"Up", Numbers{0, 0, 1}},
                                                   {"Pre-Twist", Numbers{0.0, 0.4}},
                                                   {"Pre-Twist Positions", Numbers{0.5, 1.0}}}));
  const Chain& chain = axis.chains[0];
  EXPECT_LT((chain[1].triad - chain[0].triad).norm(), 1e-15);  // constant before the table
  const Vec3 d1 = std::cos(0.2) * chain[0].triad.col(0) + std::sin(0.2) * chain[0].triad.col(1);
  EXPECT_LT((chain[3].triad.col(0) - d1).norm(), 1e-15);
}

TEST_F(AxisTypes, ArcTurnsItsTriadsAboutItsAxis) {
  const double angle = std::numbers::pi / 4.0;
  const Axis axis = make("Arc", {{"Centre", Numbers{0, 100, 0}},
                                 {"Axis", Numbers{0, 0, 1}},
                                 {"From", Numbers{0, 0, 0}},
                                 {"Angle", angle},
                                 {"Elements", 8}});
  const Chain& chain = axis.chains[0];
  ASSERT_EQ(chain.size(), 9U);
  EXPECT_LT((chain[8].position - Vec3(70.710678118655, 29.289321881345, 0)).norm(), 1e-11);
  EXPECT_LT((chain[8].triad.col(0) - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_LT((chain[8].triad.col(2) - Vec3(std::cos(angle), std::sin(angle), 0)).norm(), 1e-15);
}

TEST_F(AxisTypes, ArcThroughPointsAndHelixMeetTheirPoints) {
  const Axis arc = make("Arc Through Points", {{"From", Numbers{0, 0, 0}},
                                               {"Through", Numbers{1, 1, 0}},
                                               {"To", Numbers{2, 0, 0}},
                                               {"Elements", 2}});
  EXPECT_LT((arc.chains[0][1].position - Vec3(1, 1, 0)).norm(), 1e-15);
  const Axis helix = make("Helix", {{"Centre", Numbers{0, 0, 0}},
                                    {"Axis", Numbers{0, 0, 1}},
                                    {"From", Numbers{1, 0, 0}},
                                    {"Angle", 2.0 * std::numbers::pi},
                                    {"Pitch", 0.3},
                                    {"Elements", 5}});
  EXPECT_LT((helix.chains[0].back().position - Vec3(1, 0, 0.3)).norm(), 1e-15);
}

TEST_F(AxisTypes, SplineRunsThroughItsPointsAtEqualArcLengths) {
  const Axis axis = make(
      "Spline",
      {{"Points", Numbers{0, 0, 0, 1, 0, 4, 3, 0, 8}}, {"Up", Numbers{1, 0, 0}}, {"Elements", 2}});
  const Chain& chain = axis.chains[0];
  ASSERT_EQ(chain.size(), 3U);
  EXPECT_LT((chain[2].position - Vec3(3, 0, 8)).norm(), 1e-14);
  EXPECT_EQ(chain[1].span, 0.5);
  for (const AxisNode& node : chain) EXPECT_LT(triad_defect(node.triad), 1e-15);
}

TEST_F(AxisTypes, PolylineHasTwoNodesAtAKink) {
  const Axis axis = make("Polyline", {{"Points", Numbers{0, 0, 0, 0, 2, 0, 1, 2, 0}},
                                      {"Elements", std::vector{4, 1}}});
  ASSERT_EQ(axis.chains.size(), 2U);
  EXPECT_EQ(axis.chains[0].size(), 5U);
  EXPECT_EQ(axis.chains[1].size(), 2U);
  EXPECT_EQ(axis.chains[0].back().position, axis.chains[1].front().position);
  EXPECT_NEAR(axis.chains[1].front().span, 2.0 / 3.0, 1e-15);
  // d1 is the normal of the plane, d3 along each segment
  EXPECT_NEAR(std::abs(axis.chains[0][0].triad(2, 0)), 1.0, 1e-15);
  EXPECT_EQ(axis.chains[0][0].triad(2, 0), axis.chains[1][0].triad(2, 0));
  EXPECT_LT((axis.chains[1][0].triad.col(2) - Vec3::UnitX()).norm(), 1e-15);
}

TEST_F(AxisTypes, PolylineSharesANodeWhereThereIsNoKink) {
  const Axis axis = make(
      "Polyline", {{"Points", Numbers{0, 0, 0, 1, 0, 0, 4, 0, 0}}, {"Elements", std::vector{2}}});
  ASSERT_EQ(axis.chains.size(), 1U);
  EXPECT_EQ(axis.chains[0].size(), 5U);
}

TEST_F(AxisTypes, PolylineInSpaceNeedsUp) {
  const GivenValues bent{{"Points", Numbers{0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 1}},
                         {"Elements", std::vector{1}}};
  EXPECT_EQ(failure("Polyline", bent), "the points are not in a plane: give 'Up'");
  EXPECT_EQ(make("Polyline", with(bent, {{"Up", Numbers{1, 1, 1}}})).chains.size(), 3U);
}

TEST_F(AxisTypes, UpMustNotBeParallelToTheAxis) {
  EXPECT_EQ(failure("Line", with(two_metres, {{"Up", Numbers{-1, 0, 0}}})),
            "must not be parallel to the axis, but is at 0 of its length");
}

TEST_F(AxisTypes, ImpossibleGeometryIsNamed) {
  EXPECT_EQ(
      mistakes("Line", {{"From", Numbers{1, 2, 3}}, {"To", Numbers{1, 2, 3}}, {"Elements", 4}}),
      Messages{"must differ from 'From'"});
  EXPECT_EQ(mistakes("Arc", {{"Centre", Numbers{0, 0, 0}},
                             {"Axis", Numbers{0, 0, 1}},
                             {"From", Numbers{0, 0, 3}},
                             {"Angle", 0.0},
                             {"Elements", 8}}),
            (Messages{"must not lie on the axis", "must not be zero"}));
  EXPECT_EQ(mistakes("Arc Through Points", {{"From", Numbers{0, 0, 0}},
                                            {"Through", Numbers{1, 0, 0}},
                                            {"To", Numbers{2, 0, 0}},
                                            {"Elements", 2}}),
            Messages{"must not lie on a line with the ends"});
  EXPECT_EQ(mistakes("Polyline", {{"Points", Numbers{0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0}},
                                  {"Elements", std::vector{1, 2}}}),
            (Messages{"the line turns back at point 2", "points 3 and 4 are the same",
                      "must have one number, or one per segment: 3 segments, 2 numbers"}));
  EXPECT_EQ(mistakes("Line", with(two_metres, {{"Pre-Twist", Numbers{1.0}}})),
            Messages{"'Pre-Twist' and 'Pre-Twist Positions' need each other"});
  EXPECT_EQ(
      mistakes("Line", with(two_metres, {{"Pre-Twist", Numbers{1, 2, 3}},
                                         {"Pre-Twist Positions", Numbers{0.5, 0.2}}})),
      (Messages{"must have one position per value: 3 values, 2 positions", "must not descend"}));
}

// The triads of nodes on the x-axis, d3 = x, d1 = z; the second one is scaled.
Numbers triads(double scale) {
  return {0, 0, 1, 0, -1, 0, 1, 0, 0, 0, 0, scale, 0, -scale, 0, scale, 0, 0};
}

TEST_F(AxisTypes, NodesAreTakenAsTheyAre) {
  const Axis axis =
      make("Nodes", {{"Positions", Numbers{0, 0, 0, 2, 0, 0}}, {"Directors", triads(1.0 + 4e-7)}});
  const Chain& chain = axis.chains.at(0);
  EXPECT_LT((chain[1].triad.col(0) - Vec3::UnitZ()).norm(), 1e-15);  // made orthonormal again
  EXPECT_LT((chain[1].triad.col(1) + Vec3::UnitY()).norm(), 1e-15);
  EXPECT_EQ(chain[0].span, 0.0);
  EXPECT_EQ(chain[1].span, 1.0);
}

TEST_F(AxisTypes, NodesMustHaveSoundDirectors) {
  const Numbers positions{0, 0, 0, 2, 0, 0};
  EXPECT_EQ(mistakes("Nodes", {{"Positions", positions}, {"Directors", triads(1.01)}}),
            Messages{"node 1: directors are not orthonormal, |D^T D - 1| is 0.02 and must be <= "
                     "1e-06"});
  Numbers left_handed = triads(1.0);
  left_handed[4] = 1.0;
  EXPECT_EQ(mistakes("Nodes", {{"Positions", positions}, {"Directors", left_handed}}),
            Messages{"node 0: directors are left-handed"});
  EXPECT_EQ(
      mistakes("Nodes", {{"Positions", Numbers{0, 0, 0, -2, 0, 0}}, {"Directors", triads(1.0)}}),
      Messages{"between nodes 0 and 1 d3 points against the axis"});
  EXPECT_EQ(
      mistakes("Nodes", {{"Positions", Numbers{1, 1, 1, 1, 1, 1}}, {"Directors", triads(1.0)}}),
      Messages{"nodes 0 and 1 are at the same place"});
  EXPECT_EQ(mistakes("Nodes", {{"Positions", Numbers{0, 0, 0, 1, 0, 0, 2, 0, 0}},
                               {"Directors", triads(1.0)}}),
            Messages{"must have nine values per node: 3 nodes, 2 triads"});
  EXPECT_EQ(failure("Nodes", {{"Positions", positions}, {"Directors", triads(1.0)}}, 2),
            "elements of order 2 need 1 more than a multiple of 2 nodes, got 2");
}

TEST_F(AxisTypes, NodesOfAnElementMustNotFoldIt) {
  Numbers directors = triads(1.0);
  directors.insert(directors.end(), directors.begin(), directors.begin() + 9);
  const auto with_middle = [&](double x) {
    return GivenValues{{"Positions", Numbers{0, 0, 0, x, 0, 0, 2, 0, 0}}, {"Directors", directors}};
  };
  EXPECT_EQ(failure("Nodes", with_middle(1.6), 2),
            "between nodes 0 and 2, those of one element of order 2, the axis folds back: space "
            "them more evenly, or take 'Order' = 1");
  EXPECT_EQ(make("Nodes", with_middle(1.4), 2).chains[0].size(), 3u);
}

TEST_F(AxisTypes, RefinedCurveHasTheNodesOfManyElements) {
  GivenValues given = two_metres;
  const Axis axis = make("Line", given, 2, 3);
  given.back() = {"Elements", 12};
  const Axis other = make("Line", given, 2);
  ASSERT_EQ(axis.chains[0].size(), 25u);
  for (std::size_t i = 0; i < 25; ++i) {
    EXPECT_LT((axis.chains[0][i].position - other.chains[0][i].position).norm(), 1e-15);
  }
}

TEST_F(AxisTypes, RefinedNodesAreInterpolatedAndKeepTheGivenOnes) {
  const double turn = 0.3;
  const Mat3 last = exp_rotation(turn * Vec3::UnitZ());
  Numbers triads = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  triads.insert(triads.end(), last.data(), last.data() + 9);
  const Axis axis =
      make("Nodes", {{"Positions", Numbers{0, 0, 0, 0, 0, 4}}, {"Directors", triads}}, 1, 4);
  const Chain& chain = axis.chains[0];
  ASSERT_EQ(chain.size(), 5u);
  EXPECT_LT((chain[4].triad - last).norm(), 1e-15);
  EXPECT_EQ(chain[1].position, Vec3(0, 0, 1));
  EXPECT_EQ(chain[1].span, 0.25);
  // halfway the mean of two triads is turned by half
  EXPECT_LT((chain[2].triad - exp_rotation(0.5 * turn * Vec3::UnitZ())).norm(), 1e-14);
}

}  // namespace
}  // namespace culm::beam
