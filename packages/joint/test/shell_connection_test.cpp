#include <culm/joint/register_joint.hpp>
#include <culm/joint/shell_connection.hpp>
#include <culm/math/rotation.hpp>

#include <culm_kit/deck_list.hpp>
#include <culm_kit/dense_assembly.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace culm::joint {
namespace {

using model::NodeTable;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;
using Numbers = std::vector<double>;

/// Two strips of two elements that meet along three nodes, directors along z and `turned`, and a
/// body.
class ShellConnections : public testing::Test {
 protected:
  model::BuilderRegistry registry;
  model::Model model;
  std::map<std::string, model::Amplitude> functions;
  InputIssues issues;

  void make(const Vec3& turned, const Vec3& shift = Vec3::Zero()) {
    register_joints(registry);
    add_edge("left", Vec3::UnitZ(), Vec3::Zero(), {0, 1, 2});
    add_edge("right", turned, shift, {2, 0, 1});  // not in the same order
    model.add_structure("body").nodes = {model.nodes().add(kit::random_node(4))};
  }
  void add_edge(const std::string& name, const Vec3& d, const Vec3& shift,
                const std::vector<int>& order) {
    model::Structure& edge = model.add_structure(name);
    for (int y : order) {
      model::NodeSlots slots = model::NodeSlots::Zero();
      slots.col(0) = y * Vec3::UnitY() + shift;
      slots.col(1) = d;
      edge.nodes.push_back(model.nodes().add(slots, NodeKind::node6));
    }
    edge.faces.push_back({{edge.nodes[0], edge.nodes[1], edge.nodes[2], edge.nodes[2]}, 0.2});
  }
  // A node at the place of another one.
  int copy_of(int node) {
    const model::NodeSlots slots = NodeTable::slots(model.nodes().reference(), node);
    return model.nodes().add(slots, NodeKind::node6);
  }
  void build(const std::string& type, const kit::GivenValues& values) {
    const Schema schema = registry.variants().at(type);
    const Options options = kit::deck_list(schema, values, "seam");
    EXPECT_THAT(kit::mistakes_in(schema, options), ElementsAre());
    model::BuildContext context{model, functions, issues};
    registry.make(type, options, context);
  }
  void join(const std::string& type, const kit::GivenValues& more = {}) {
    kit::GivenValues values = {{"First", std::string("left")}, {"Second", std::string("right")}};
    values.insert(values.end(), more.begin(), more.end());
    build(type, values);
  }
  std::vector<std::string> messages() const {
    std::vector<std::string> result;
    for (const InputIssue& issue : issues.sorted()) result.push_back(issue.message);
    return result;
  }
  std::vector<std::size_t> rows() const {
    std::vector<std::size_t> result;
    for (const model::Constraint& c : model.constraints()) result.push_back(c.rows.size());
    return result;
  }
};

TEST_F(ShellConnections, NodesArePairedByPlace) {
  make(Vec3::UnitX());
  join("Fold Connection");
  EXPECT_THAT(messages(), ElementsAre());
  ASSERT_EQ(model.constraints().size(), 3U);
  EXPECT_THAT(model.constraints()[0].nodes, ElementsAre(2, 3));
  EXPECT_THAT(model.constraints()[1].nodes, ElementsAre(0, 4));
  EXPECT_EQ(model.constraints()[1].name, "seam at right/1");
  EXPECT_THAT(rows(), ElementsAre(4, 4, 4));
}

TEST_F(ShellConnections, InextensibleFoldsHoldBothLengths) {
  make(Vec3::UnitX());
  join("Fold Connection", {{"Inextensible", true}});
  EXPECT_THAT(rows(), ElementsAre(6, 6, 6));
}

TEST_F(ShellConnections, SmoothConnectionsAreEliminated) {
  make(Vec3::UnitZ());
  join("Smooth Connection");
  EXPECT_THAT(messages(), ElementsAre());
  EXPECT_THAT(rows(), ElementsAre(6, 6, 6));
  EXPECT_THAT(model.freeze(model::Form::null_space), ElementsAre());
  EXPECT_TRUE(model.equations().empty());
  EXPECT_EQ(model.unknowns().num_unknowns(), 4 * 6);
  // and the rows of the other form hold
  model::State state = model.initial_state();
  NodeTable::slots(state.next, 0).leftCols<2>() << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  kit::follow_masters(model.nodes(), state.next);
  for (const model::Constraint& c : model.constraints()) {
    for (const auto& row : c.rows) {
      EXPECT_NEAR(model::row_value(row, model::slots_of(c, state.next)), 0.0, 1e-15);
    }
  }
}

TEST_F(ShellConnections, WhatIsNotQuiteTogetherKeepsItsDifference) {
  make(Vec3(0.001, 0.0, 1.0), 1e-5 * Vec3::UnitX());
  join("Smooth Connection");
  EXPECT_THAT(messages(), ElementsAre());
  for (const model::Constraint& c : model.constraints()) {
    EXPECT_FALSE(c.link);
    EXPECT_EQ(c.rows.size(), 6U);
    for (const auto& row : c.rows) {
      EXPECT_NEAR(model::row_value(row, model::slots_of(c, model.nodes().reference())), 0.0, 1e-16);
    }
  }
}

// Opposite normals: d_A + d_B is what stays.
TEST_F(ShellConnections, FoldsOfOppositeDirectorsAreStiff) {
  make(-Vec3::UnitZ());
  join("Fold Connection");
  EXPECT_THAT(rows(), ElementsAre(6, 6, 6));
  model::Coordinates q = model.nodes().reference();
  for (int node = 0; node < 6; ++node) {  // turned about y
    auto slots = NodeTable::slots(q, node);
    slots = (exp_rotation(0.7 * Vec3::UnitY()) * slots).eval();
  }
  for (const model::Constraint& c : model.constraints()) {
    for (const auto& row : c.rows) {
      EXPECT_NEAR(model::row_value(row, model::slots_of(c, q)), 0.0, 1e-15);
    }
  }
}

TEST_F(ShellConnections, LayersTouchAtTheirFaces) {
  make(Vec3::UnitZ(), 0.2 * Vec3::UnitZ());
  join("Layer Connection");
  EXPECT_THAT(messages(), ElementsAre());
  EXPECT_THAT(rows(), ElementsAre(3, 3, 3));
  for (const model::Constraint& c : model.constraints()) {
    for (const auto& row : c.rows) EXPECT_NEAR(row.constant, 0.0, 1e-16);
  }
}

TEST_F(ShellConnections, HingesJoinNodesOfAnyKind) {
  make(Vec3::UnitX());
  join("Hinge Connection");
  EXPECT_THAT(rows(), ElementsAre(3, 3, 3));
  build("Hinge Connection",
        {{"First", std::string("body")}, {"Second", std::string("left/0")}, {"Tolerance", 10.0}});
  EXPECT_THAT(messages(), ElementsAre());
}

// Walls of any angle, made thicker or thinner alike, keep it; the moment of a fold does not pull at
// its directors; and its row tells by how much they turn.
TEST_F(ShellConnections, FoldsHoldTheAngleAndNoThickness) {
  for (const double angle : {0.1, 0.5, 1.2, 1.6, 2.4, 3.05}) {
    NodeTable nodes;
    for (const double a : {0.0, angle}) {
      model::NodeSlots slots = model::NodeSlots::Zero();
      slots.col(1) = exp_rotation(a * Vec3::UnitY()) * Vec3::UnitZ();
      nodes.add(slots, NodeKind::node6);
    }
    const model::Constraint fold = fold_connection(nodes, 0, 1);
    const model::ConstraintRow& row = fold.rows.back();
    const Eigen::Matrix3Xd q = model::slots_of(fold, nodes.reference());
    EXPECT_NEAR(model::row_value(row, q), 0.0, 1e-14);
    EXPECT_NEAR(model::row_value(row, 1.3 * q), 0.0, 1e-13) << angle;

    const double h = 1e-5;
    for (const int slot : {1, 5}) {
      const auto change = [&](const Vec3& motion) {
        Eigen::Matrix3Xd ahead = q;
        Eigen::Matrix3Xd behind = q;
        ahead.col(slot) += h * motion;
        behind.col(slot) -= h * motion;
        return (model::row_value(row, ahead) - model::row_value(row, behind)) / (2.0 * h);
      };
      const Vec3 d = q.col(slot);
      EXPECT_NEAR(change(d), 0.0, 1e-9) << "thickness, angle " << angle;
      const double opens = slot == 1 ? 1.0 : -1.0;  // d_A towards d_B lets the cosine grow
      EXPECT_NEAR(change(Vec3::UnitY().cross(d)), opens, 1e-9) << "turn, angle " << angle;
      EXPECT_NEAR(change(Vec3::UnitY()), 0.0, 1e-9) << "tilt, angle " << angle;
    }
  }
}

// Forces of a fold balance at the middle of a step between places where it holds.
TEST_F(ShellConnections, FoldsKeepTheMomenta) {
  make(Vec3(0.6, 0.0, -0.8));
  join("Fold Connection");
  const model::Constraint& fold = model.constraints().front();
  Eigen::Matrix3Xd q = Eigen::Matrix3Xd::Zero(3, 8);
  for (int seed : {1, 2}) {  // the sum of two rigid motions of the fold
    const kit::RigidMotion motion = kit::RigidMotion::random(seed);
    const Eigen::Matrix3Xd reference = model::slots_of(fold, model.nodes().reference());
    for (int s = 0; s < 8; ++s) {
      q.col(s) +=
          0.5 * (motion.R * reference.col(s) + (s % 4 == 0 ? motion.shift : Vec3::Zero().eval()));
    }
  }
  for (const model::ConstraintRow& row : fold.rows) {
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    for (int s = 0; s < 8; ++s) {
      Vec3 f;  // differences of a quadratic form are exact
      for (int i = 0; i < 3; ++i) {
        Eigen::Matrix3Xd ahead = q;
        Eigen::Matrix3Xd behind = q;
        ahead(i, s) += 0.5;
        behind(i, s) -= 0.5;
        f[i] = model::row_value(row, ahead) - model::row_value(row, behind);
      }
      if (s % 4 == 0) force += f;
      moment += Vec3(q.col(s)).cross(f);
    }
    EXPECT_LT(force.norm(), 1e-14);
    EXPECT_LT(moment.norm(), 1e-14);
  }
}

TEST_F(ShellConnections, TransitionsTakeShellNodesAndATriad) {
  make(Vec3::UnitX());
  build("Soft Transition", {{"Node", std::string("left")}, {"Master", std::string("body")}});
  build("Rigid Connection", {{"Node", std::string("right")}, {"Master", std::string("body")}});
  EXPECT_THAT(messages(), ElementsAre());
  EXPECT_THAT(rows(), ElementsAre(4, 4, 4, 6, 6, 6));
  EXPECT_THAT(model.freeze(model::Form::multipliers), ElementsAre());
}

TEST_F(ShellConnections, MistakesAreNamed) {
  make(Vec3::UnitX(), 0.5 * Vec3::UnitX());
  join("Fold Connection");
  join("Smooth Connection", {{"Tolerance", 1.0}});
  build("Fold Connection", {{"First", std::string("left")}, {"Second", std::string("left/1")}});
  build("Soft Transition", {{"Node", std::string("body")}, {"Master", std::string("left/0")}});
  build("Rigid Connection", {{"Node", std::string("body")}, {"Master", std::string("left/0")}});
  build("Inextensible Director", {{"Node", std::string("body")}});
  EXPECT_THAT(messages(),
              UnorderedElementsAre(
                  HasSubstr("node 'right/0' is 0.5 m from the nearest of First, 'left/2'"),
                  HasSubstr("'right/0' and 'left/2' are not parallel; a Fold Connection keeps"),
                  "node 'left/1' is one of First as well", "node 'body/0' is not one of a shell",
                  HasSubstr("node 'left/0' is one of a shell and has no triad to follow"),
                  "node 'body/0' is not one of a shell"));
}

TEST_F(ShellConnections, NodesOfTheFirstBetweenThoseOfTheSecondAreRefused) {
  make(Vec3::UnitZ());
  model::Structure& coarse = model.add_structure("coarse");
  for (const int node : {1, 2}) coarse.nodes.push_back(copy_of(node));
  coarse.cells.push_back({{coarse.nodes[0], coarse.nodes[1]}, nullptr, 0});
  build("Smooth Connection", {{"First", std::string("left")}, {"Second", std::string("coarse")}});
  EXPECT_THAT(messages(), ElementsAre());  // what lies beyond its end is free

  model::Structure& both = model.add_structure("both");
  for (const int node : {0, 2}) both.nodes.push_back(copy_of(node));
  both.cells.push_back({{both.nodes[0], both.nodes[1]}, nullptr, 0});
  build("Smooth Connection", {{"First", std::string("left")}, {"Second", std::string("both")}});
  EXPECT_THAT(messages(),
              ElementsAre(HasSubstr("1 of 3 nodes, 'left/1' the first of them, lie between")));
}

TEST_F(ShellConnections, TypesThatNeedATriadRefuseShells) {
  make(Vec3::UnitX());
  const kit::GivenValues axis = {{"Node", std::string("left/1")}, {"Axis", Numbers{0.0, 0.0, 1.0}}};
  build("Rotation", axis);
  build("Rotation Local", axis);
  build("Simple Support Local",
        {{"Node", std::string("left/1")}, {"Direction", Numbers{0.0, 0.0, 1.0}}});
  kit::GivenValues turning = axis;
  turning.emplace_back("Angular Velocity", 1.0);
  build("Angular Velocity", turning);
  build("Spherical Support", {{"Node", std::string("left/1")}, {"Offset", Numbers{0.0, 0.0, 1.0}}});
  build("Weld", {{"First", std::string("left/1")}, {"Second", std::string("body/0")}});
  build("Revolute Joint", {{"First", std::string("body/0")},
                           {"Second", std::string("left/1")},
                           {"Axis", Numbers{0.0, 0.0, 1.0}}});
  EXPECT_TRUE(model.constraints().empty());
  EXPECT_EQ(messages().size(), 7U);
  for (const std::string& message : messages()) {
    EXPECT_THAT(message, HasSubstr("node 'left/1' is one of a shell"));
  }
}

}  // namespace
}  // namespace culm::joint
