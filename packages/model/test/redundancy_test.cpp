#include <culm/math/rotation.hpp>
#include <culm/model/redundancy.hpp>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

namespace culm::model {
namespace {

using testing::HasSubstr;

int add_node(NodeTable& nodes, const Vec3& position) {
  NodeSlots slots;
  slots << position, Mat3::Identity();
  return nodes.add(slots);
}

// Five rows: common point, parallel axis z.
Constraint hinge(const NodeTable& nodes, int a, int b, const Vec3& point) {
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
        product_row(attached_vector(0, 2, Vec3::Unit(i)), attached_vector(1, 2, Vec3::UnitZ()), q));
  }
  return c;
}

std::size_t count_rows(const std::vector<Constraint>& equations) {
  std::size_t rows = 0;
  for (const Constraint& c : equations) rows += c.rows.size();
  return rows;
}

TEST(Redundancy, SoundJointsLoseNothing) {
  NodeTable nodes;
  for (int i = 0; i < 4; ++i) add_node(nodes, Vec3(i, 0.3 * i * i, 0.0));
  std::vector<Constraint> chain;
  for (int i = 0; i < 3; ++i) chain.push_back(hinge(nodes, i, i + 1, Vec3(i + 0.5, 0.0, 0.2)));
  EXPECT_TRUE(remove_redundant_rows(nodes, chain).empty());
  EXPECT_EQ(count_rows(chain), 15U);
}

TEST(Redundancy, TwoHingesOnOneAxisAreOneHinge) {
  NodeTable nodes;
  for (int i = 0; i < 2; ++i) add_node(nodes, Vec3(i, 0.0, 0.0));
  std::vector<Constraint> hinges = {hinge(nodes, 0, 1, Vec3(0.5, 0.0, 0.0)),
                                    hinge(nodes, 0, 1, Vec3(0.5, 0.0, 2.0))};
  const auto notes = remove_redundant_rows(nodes, hinges);
  EXPECT_EQ(count_rows(hinges), 5U);
  EXPECT_FALSE(notes.empty());
}

TEST(Redundancy, PlaneFourBarLoopHasThreeRowsTooMany) {
  NodeTable nodes;
  const int ground = add_node(nodes, Vec3::Zero());
  nodes.fix(ground, std::bitset<6>("111111"));
  const int left = add_node(nodes, Vec3(0.0, 0.5, 0.0));
  const int top = add_node(nodes, Vec3(0.5, 1.0, 0.0));
  const int right = add_node(nodes, Vec3(1.0, 0.5, 0.0));
  std::vector<Constraint> loop = {hinge(nodes, ground, left, Vec3(0.0, 0.0, 0.0)),
                                  hinge(nodes, left, top, Vec3(0.0, 1.0, 0.0)),
                                  hinge(nodes, top, right, Vec3(1.0, 1.0, 0.0)),
                                  hinge(nodes, right, ground, Vec3(1.0, 0.0, 0.0))};
  const auto notes = remove_redundant_rows(nodes, loop);
  EXPECT_EQ(count_rows(loop), 17U);  // 18 unknowns, one degree of freedom
  ASSERT_FALSE(notes.empty());
  EXPECT_THAT(notes.front(), HasSubstr("equations follow from other constraints"));
}

TEST(Redundancy, JointsBetweenHeldNodesVanish) {
  NodeTable nodes;
  for (int i = 0; i < 2; ++i) {
    add_node(nodes, Vec3(i, 0.0, 0.0));
    nodes.fix(i, std::bitset<6>("111111"));
  }
  std::vector<Constraint> joint = {hinge(nodes, 0, 1, Vec3(0.5, 0.0, 0.0))};
  EXPECT_EQ(remove_redundant_rows(nodes, joint).size(), 1U);
  EXPECT_TRUE(joint.empty());
}

}  // namespace
}  // namespace culm::model
