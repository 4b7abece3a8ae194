#include <culm/math/rotation.hpp>
#include <culm/model/model.hpp>
#include <culm/model/redundancy.hpp>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

namespace culm::model {
namespace {

using testing::ElementsAre;
using Kind = RedundantSet::Kind;

int add_node(NodeTable& nodes, const Vec3& position) {
  NodeSlots slots;
  slots << position, Mat3::Identity();
  return nodes.add(slots);
}

// x becomes y, y becomes z and z becomes x
const Mat3 turn_once = (Mat3() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished();

// Five rows: common point, parallel axis z of some axes.
Constraint hinge(const NodeTable& nodes, int a, int b, const Vec3& point,
                 const Mat3& axes = Mat3::Identity()) {
  Constraint c;
  c.type = "Revolute Joint";
  c.name = std::to_string(a) + "-" + std::to_string(b);
  c.nodes = {a, b};
  Eigen::Matrix3Xd q(3, 8);
  q << NodeTable::slots(nodes.reference(), a), NodeTable::slots(nodes.reference(), b);
  SlotSum gap = attached_point(0, 2, point - q.col(0));
  const SlotSum other = attached_point(1, 2, point - q.col(4));
  for (std::size_t s = 4; s < 8; ++s) gap[s] = -other[s];
  for (int i = 0; i < 3; ++i) c.rows.push_back(linear_row(Vec3::Unit(i), gap, q));
  for (int i = 0; i < 2; ++i) {
    c.rows.push_back(
        product_row(attached_vector(0, 2, axes.col(i)), attached_vector(1, 2, axes.col(2)), q));
  }
  return c;
}

std::vector<RedundantSet> find(const NodeTable& nodes, const std::vector<Constraint>& equations,
                               Form form = Form::null_space) {
  return find_redundant_rows(nodes, equations, form, nodes.reference());
}

// A plane loop of four hinges about z; the ground is held.
std::vector<Constraint> four_bar(NodeTable& nodes, const std::array<Vec3, 4>& hinges) {
  std::vector<Constraint> loop;
  for (int i = 0; i < 4; ++i) {
    const auto at = static_cast<std::size_t>(i);
    add_node(nodes, 0.5 * (hinges[at] + hinges[(at + 3) % 4]));
  }
  nodes.fix(0, std::bitset<6>("111111"));
  for (int i = 0; i < 4; ++i) {
    loop.push_back(hinge(nodes, i, (i + 1) % 4, hinges[static_cast<std::size_t>(i)]));
  }
  return loop;
}

TEST(Redundancy, SoundJointsLoseNothing) {
  NodeTable nodes;
  for (int i = 0; i < 4; ++i) add_node(nodes, Vec3(i, 0.3 * i * i, 0.0));
  std::vector<Constraint> chain;
  for (int i = 0; i < 3; ++i) chain.push_back(hinge(nodes, i, i + 1, Vec3(i + 0.5, 0.0, 0.2)));
  EXPECT_TRUE(find(nodes, chain).empty());
  EXPECT_TRUE(find(nodes, chain, Form::multipliers).empty());
}

TEST(Redundancy, TwoHingesOnOneAxisAreOneHinge) {
  for (const Form form : {Form::null_space, Form::multipliers}) {
    NodeTable nodes;
    for (int i = 0; i < 3; ++i) add_node(nodes, Vec3(i, 0.0, 0.0));
    const std::vector<Constraint> hinges = {hinge(nodes, 1, 2, Vec3(1.5, 0.3, 0.0)),
                                            hinge(nodes, 0, 1, Vec3(0.5, 0.0, 0.0)),
                                            hinge(nodes, 0, 1, Vec3(0.5, 0.0, 2.0))};
    const auto sets = find(nodes, hinges, form);
    ASSERT_EQ(sets.size(), 1U);
    EXPECT_EQ(sets[0].kind, Kind::structural);
    EXPECT_EQ(sets[0].dependent.size(), 5U);
    EXPECT_THAT(sets[0].members, ElementsAre(1, 2));  // the first joint is not in it
  }
}

TEST(Redundancy, PlaneFourBarLoopHasThreeRowsTooMany) {
  NodeTable nodes;
  const auto loop = four_bar(
      nodes, {Vec3(0.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(1.0, 1.2, 0.0), Vec3(1.0, 0.0, 0.0)});
  const auto sets = find(nodes, loop);
  ASSERT_EQ(sets.size(), 1U);
  EXPECT_EQ(sets[0].kind, Kind::structural);
  EXPECT_EQ(sets[0].dependent.size(), 3U);  // 20 rows, 18 unknowns, one degree of freedom
  EXPECT_THAT(sets[0].members, ElementsAre(0, 1, 2, 3));
}

// Parallel links under two bars: rotations out of the plane lead such loops back to positions that
// are singular themselves, in which more rows depend on each other than at the start.
TEST(Redundancy, TheVerdictOnParallelLoopsDoesNotDependOnTheAxes) {
  const std::array<Vec3, 5> centres = {Vec3(0.0, 0.5, 0.0), Vec3(1.0, 0.5, 0.0),
                                       Vec3(2.0, 0.5, 0.0), Vec3(0.5, 1.0, 0.0),
                                       Vec3(1.5, 1.0, 0.0)};
  Mat3 turn = Mat3::Identity();
  for (int axes = 0; axes < 3; ++axes, turn = turn * turn_once) {
    NodeTable nodes;
    for (const Vec3& centre : centres) add_node(nodes, turn * centre);
    const int ground = add_node(nodes, Vec3::Zero());
    nodes.fix(ground, std::bitset<6>("111111"));
    std::vector<Constraint> hinges;
    const auto add = [&](int a, int b, const Vec3& point) {
      hinges.push_back(hinge(nodes, a, b, turn * point, turn));
    };
    for (int i = 0; i < 3; ++i) add(ground, i, Vec3(i, 0.0, 0.0));
    for (int bar = 0; bar < 2; ++bar) {
      for (int i = 0; i < 2; ++i) add(bar + i, bar + 3, Vec3(bar + i, 1.0, 0.0));
    }
    const auto sets = find(nodes, hinges);
    ASSERT_EQ(sets.size(), 1U);
    EXPECT_EQ(sets[0].kind, Kind::structural);
    EXPECT_EQ(sets[0].dependent.size(), 6U);  // 35 rows, 30 unknowns, one degree of freedom
  }
}

TEST(Redundancy, AStretchedLoopDependsInThisPositionOnly) {
  NodeTable nodes;  // lengths 3, 1, 1.2, 3.2 - 2: a change point of the linkage
  const auto loop = four_bar(
      nodes, {Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0), Vec3(2.2, 0.0, 0.0), Vec3(0.8, 0.0, 0.0)});
  const auto sets = find(nodes, loop);
  ASSERT_EQ(sets.size(), 1U);
  EXPECT_EQ(sets[0].dependent.size(), 4U);
  EXPECT_EQ(sets[0].kind, Kind::position);
}

TEST(Redundancy, JointsBetweenHeldNodesVanish) {
  NodeTable nodes;
  for (int i = 0; i < 2; ++i) {
    add_node(nodes, Vec3(i, 0.0, 0.0));
    nodes.fix(i, std::bitset<6>("111111"));
  }
  const auto sets = find(nodes, {hinge(nodes, 0, 1, Vec3(0.5, 0.0, 0.0))});
  ASSERT_EQ(sets.size(), 5U - 4U);  // rows of one constraint are one set
  EXPECT_EQ(sets[0].dependent.size(), 5U);
  EXPECT_EQ(sets[0].kind, Kind::structural);
}

// Takes unknowns of a node away.
Constraint support(const std::string& name, int node, const char* unknowns) {
  Constraint c;
  c.type = "Support";
  c.name = name;
  c.nodes = {node};
  c.fix = {node, std::bitset<6>(unknowns)};
  return c;
}

class RepeatedSupports : public testing::Test {
 protected:
  void SetUp() override {
    for (int i = 0; i < 3; ++i) {
      NodeSlots slots;
      slots << Vec3(i, 0.0, 0.0), Mat3::Identity();
      model.add_structure(std::string(1, static_cast<char>('a' + i))).nodes = {
          model.nodes().add(slots)};
    }
  }
  Model model;
};

TEST_F(RepeatedSupports, AreNamedWithNodeAndDirections) {
  model.add_constraint(support("one", 0, "111111"));
  model.add_constraint(support("two", 0, "000110"));
  model.add_constraint(support("far", 1, "000110"));
  EXPECT_THAT(
      model.freeze(Form::null_space),
      ElementsAre("Support 'one' and Support 'two' hold motions of 'a/0' more than once: y, "
                  "z; the reactions of these constraints are not unique"));
}

// One note for all nodes of two supports; each node adds its name to that of its support.
TEST_F(RepeatedSupports, AreToldOnceForAllNodes) {
  for (int node = 0; node < 3; ++node) {
    const std::string at = " at " + model.node_name(node);
    model.add_constraint(support("rim" + at, node, "001000"));
    model.add_constraint(support("edge" + at, node, "111000"));
  }
  EXPECT_THAT(
      model.freeze(Form::null_space),
      ElementsAre("Support 'rim' and Support 'edge' hold motions of 'a/0', 'b/0', 'c/0' more "
                  "than once: rotation x; the reactions of these constraints are not "
                  "unique"));
}

TEST_F(RepeatedSupports, AreSeenThroughRigidConnections) {
  model.add_rigid_link("link", 1, 0);
  model.add_constraint(support("one", 0, "111111"));
  model.add_constraint(support("two", 1, "111111"));
  EXPECT_THAT(
      model.freeze(Form::null_space),
      ElementsAre("Support 'one' and Support 'two' hold motions of 'a/0', 'b/0' more than "
                  "once: x, y, z, rotation x, rotation y, rotation z; the reactions of these "
                  "constraints are not unique"));
}

TEST_F(RepeatedSupports, NoneWhereEachHoldsItsOwn) {
  model.add_constraint(support("one", 0, "000011"));
  model.add_constraint(support("two", 0, "111100"));
  EXPECT_TRUE(model.freeze(Form::null_space).empty());
}

// x of a node is `amount` t
Constraint push(const NodeTable& nodes, int node, double amount) {
  Constraint c;
  c.nodes = {node};
  c.rows = {linear_row(Vec3::UnitX(), attached_point(0, 1, Vec3::Zero()),
                       NodeTable::slots(nodes.reference(), node))};
  const double start = c.rows[0].constant;
  c.drive = [=](double time, std::vector<ConstraintRow>& rows) {
    rows[0].constant = start + amount * time;
  };
  return c;
}

TEST(Redundancy, DrivesAreConsistentWhereTheyAskForTheSameMotion) {
  NodeTable nodes;
  add_node(nodes, Vec3(1.0, 2.0, 3.0));
  const auto same = find(nodes, {push(nodes, 0, 0.3), push(nodes, 0, 0.3)});
  ASSERT_EQ(same.size(), 1U);
  EXPECT_EQ(same[0].kind, Kind::structural);
  const auto other = find(nodes, {push(nodes, 0, 0.3), push(nodes, 0, 0.4)});
  ASSERT_EQ(other.size(), 1U);
  EXPECT_EQ(other[0].kind, Kind::contradictory);
  nodes.fix(0, std::bitset<6>("000001"));
  EXPECT_EQ(find(nodes, {push(nodes, 0, 0.3)}).at(0).kind, Kind::contradictory);
}

}  // namespace
}  // namespace culm::model
