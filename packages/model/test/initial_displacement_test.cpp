#include <culm/base/error.hpp>
#include <culm/math/rotation.hpp>
#include <culm/model/model.hpp>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include <algorithm>

namespace culm::model {
namespace {

using testing::HasSubstr;

class InitialDisplacements : public testing::Test {
 protected:
  Model model;
  InitialDisplacements() {
    for (int i = 0; i < 2; ++i) {
      NodeSlots slots;
      slots << Vec3(i, 0.5, 0.0), exp_rotation(Vec3(0.3, 0.2 * i, -0.4));
      model.nodes().add(slots);
    }
    model.add_structure("bar").nodes = {0, 1};
  }
  // x and y of a node
  static Constraint guide(const NodeTable& nodes, int node) {
    Constraint c;
    c.type = "Guide";
    c.name = "rail";
    c.nodes = {node};
    for (int axis = 0; axis < 2; ++axis) {
      c.rows.push_back(linear_row(Vec3::Unit(axis), attached_point(0, 1, Vec3::Zero()),
                                  NodeTable::slots(nodes.reference(), node)));
    }
    c.fix = Constraint::Fix{node, std::bitset<6>("000011")};
    return c;
  }
};

TEST_F(InitialDisplacements, TurnAboutAPointThenShift) {
  const Vec3 about(0.2, -0.3, 0.9);
  const Vec3 turn(0.1, 0.7, -0.2);
  const Vec3 shift(1.0, 2.0, 3.0);
  model.add_initial_displacement({{}, 1, shift, turn, about});
  model.freeze(Form::null_space);
  const State state = model.initial_state();
  const NodeSlots before = NodeTable::slots(model.nodes().reference(), 1);
  const NodeSlots after = NodeTable::slots(state.next, 1);
  const Mat3 R = exp_rotation(turn);
  EXPECT_LT((after.col(0) - (about + R * (before.col(0) - about) + shift)).norm(), 1e-15);
  EXPECT_LT((after.rightCols<3>() - R * before.rightCols<3>()).norm(), 1e-15);
  EXPECT_EQ(NodeTable::slots(state.next, 0), NodeTable::slots(model.nodes().reference(), 0));
  EXPECT_TRUE(std::ranges::equal(state.prev, state.next));
}

TEST_F(InitialDisplacements, DoNotLeaveSupports) {
  model.add_constraint(guide(model.nodes(), 0));
  model.add_initial_displacement(
      {{"deck.xml", 7, "here"}, 0, Vec3(0.25, 0.0, 1.0), Vec3::Zero(), Vec3::Zero()});
  try {
    model.freeze(Form::multipliers);
    FAIL() << "the support was left";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("deck.xml:7: here: takes 'bar/0' out of Guide 'rail' by "
                                        "0.25"));
  }
}

TEST_F(InitialDisplacements, AlongASupportAreAllowed) {
  model.add_constraint(guide(model.nodes(), 0));
  model.add_initial_displacement({{}, 0, Vec3(0.0, 0.0, 1.0), Vec3::Zero(), Vec3::Zero()});
  EXPECT_TRUE(model.freeze(Form::null_space).empty());
}

// A drive that loses one of its rows moves the others as before.
TEST_F(InitialDisplacements, DrivesGoOnWithoutRedundantRows) {
  Constraint push = guide(model.nodes(), 0);
  push.fix.reset();
  push.name = "push";
  const double x = push.rows[0].constant;
  const double y = push.rows[1].constant;
  push.drive = [=](double time, std::vector<ConstraintRow>& rows) {
    rows[0].constant = x;
    rows[1].constant = y + time;
  };
  model.add_constraint(push);
  Constraint hold = guide(model.nodes(), 0);
  hold.fix = Constraint::Fix{0, std::bitset<6>("000001")};
  hold.rows.pop_back();
  model.add_constraint(hold);
  const auto notes = model.freeze(Form::null_space);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0], HasSubstr("Guide 'push' and Guide 'rail' hold motions of 'bar' more than "
                                  "once: 1 equation follows from the others and is left out"));
  ASSERT_EQ(model.equations().size(), 1U);
  Constraint kept = model.equations()[0];
  ASSERT_EQ(kept.rows.size(), 1U);
  kept.drive(0.75, kept.rows);
  ASSERT_EQ(kept.rows.size(), 1U);
  EXPECT_EQ(kept.rows[0].constant, y + 0.75);
}

}  // namespace
}  // namespace culm::model
