#include <culm/assembly/system.hpp>
#include <culm/solver/linear_solver.hpp>

#include <culm_kit/chain_model.hpp>
#include <culm_kit/dense_assembly.hpp>
#include <gtest/gtest.h>

#include <algorithm>

namespace culm::solver {
namespace {

using model::Form;
using model::NodeTable;

// A clamped chain; a point fixed to node 5 stays at the place of node 2. Node 5 starts elsewhere.
void build(model::Model& model, Form form) {
  kit::add_chain(model, 6);
  model.add_constraint(kit::clamp(model, 0));
  model::Constraint joint;
  joint.name = joint.type = "joint";
  joint.nodes = {2, 5};
  const Eigen::Matrix3Xd q = slots_of(joint, model.nodes().reference());
  const Vec3 arm = q.col(0) - q.col(4);
  for (int i = 0; i < 3; ++i) {
    joint.rows.push_back(
        model::linear_row(Vec3::Unit(i), {1.0, 0.0, 0.0, 0.0, -1.0, -arm[0], -arm[1], -arm[2]}, q));
  }
  model.add_constraint(joint);
  model.add_initial_displacement(
      {{}, 5, Vec3(0.1, -0.2, 0.05), Vec3(0.3, 0.1, -0.2), Vec3::Zero()});
  model.freeze(form);
}

class ProjectPosition : public ::testing::TestWithParam<Form> {};

TEST_P(ProjectPosition, FulfilsConstraints) {
  model::Model model;
  build(model, GetParam());
  Ledger ledger;
  const parallel::Comm comm;
  assembly::System system(model, comm, ledger);
  const auto linear = make_rooted_klu2(system.matrix(), comm);
  model::State state = model.initial_state();
  const model::Coordinates start = state.next;
  const Stencil stencil = Stencil::statics();
  const auto violation = [&] {
    return system.evaluate(state, stencil, Want::residual).constraint_violation;
  };
  EXPECT_GT(violation(), 0.01);
  const double change =
      system.project_position(state, [&](const assembly::Vector& b, assembly::Vector& x) {
        ASSERT_TRUE(linear->factor());
        linear->solve(b, x);
      });
  EXPECT_LT(violation(), 1e-14);
  EXPECT_GT(change, 0.01);
  EXPECT_LT(change, 1.0);
  EXPECT_TRUE(std::ranges::equal(state.prev, state.next));
  for (double multiplier : state.multipliers) EXPECT_EQ(multiplier, 0.0);
  system.synchronise(state);
  const auto moved = [&](int node) {
    return (NodeTable::slots(state.next, node) - NodeTable::slots(start, node)).norm();
  };
  EXPECT_EQ(moved(0), 0.0);
  EXPECT_GT(moved(5), 0.01);
  const auto triad = NodeTable::slots(state.next, 5).rightCols<3>();
  EXPECT_LT((triad.transpose() * triad - Mat3::Identity()).norm(), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Forms, ProjectPosition,
                         ::testing::Values(Form::null_space, Form::multipliers),
                         [](const auto& form) {
                           return form.param == Form::null_space ? "NullSpace" : "Multipliers";
                         });

}  // namespace
}  // namespace culm::solver
