#include <culm/assembly/rounding.hpp>
#include <culm/model/element_batch.hpp>

#include <culm_kit/chain_model.hpp>
#include <culm_kit/dense_assembly.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace culm::assembly {
namespace {

using model::Form;

// A chain with everything that changes places: a clamp, a slave with a lever, a constraint kept as
// equations.
void build(model::Model& model, Form form) {
  kit::add_chain(model, 12);
  model.add_constraint(kit::clamp(model, 0));
  model.add_rigid_link("link", 5, 4);
  model::Constraint joint = kit::pin(model, 9);
  joint.fix.reset();
  joint.nodes = {9, 11};
  for (model::ConstraintRow& row : joint.rows) row.alpha = {1.0, 0, 0, 0, -1.0, 0, 0, 0.2};
  model.add_constraint(joint);
  model.freeze(form);
}

class SystemTest : public ::testing::TestWithParam<Form> {};

System::Motions motions_of(const System& system, const model::State& state) {
  System::Motions motions(system.num_motions());
  system.motions(state, 0, motions);
  return motions;
}

TEST_P(SystemTest, DistributedSystemEqualsDenseAssembly) {
  model::Model reference_model;
  build(reference_model, GetParam());
  kit::DenseAssembly dense(reference_model);
  model::State state = kit::random_state(reference_model, 3);
  const Stencil stencil = Stencil::midpoint(0.1);
  dense.prepare(state, stencil);
  const Eigen::VectorXd residual = dense.residual(state, stencil);
  const Eigen::MatrixXd tangent = dense.tangent(state, stencil);

  model::Model model;
  build(model, GetParam());
  Ledger ledger;
  System system(model, parallel::Comm(), ledger);
  system.prepare(state, stencil);
  const Evaluation found = system.evaluate(state, stencil, Want::residual_and_tangent);
  EXPECT_EQ(found.verdict, Verdict::ok);

  const Matrix& matrix = *system.matrix();
  const auto values = system.residual().values();
  const double size = tangent.cwiseAbs().maxCoeff();
  Eigen::MatrixXd sparse = Eigen::MatrixXd::Zero(static_cast<int>(values.size()), tangent.cols());
  matrix.each_entry([&](std::size_t row, long long column, double value) {
    sparse(static_cast<Eigen::Index>(row), column) = value;
  });
  for (std::size_t row = 0; row < values.size(); ++row) {
    const auto global = matrix.rows().global(row);
    // only the order of additions may differ
    EXPECT_NEAR(values[row], residual[global], 1e-13 * size);
    const auto at = static_cast<Eigen::Index>(row);
    EXPECT_LT((sparse.row(at) - tangent.row(global)).cwiseAbs().maxCoeff(), 1e-13 * size);
  }
}

// Of the tangent, whose columns begin with the rows of a rank, and of a matrix that was given
// whole, where columns that nothing stands in are left out.
TEST_P(SystemTest, ProductsAreThoseOfTheWholeMatrix) {
  model::Model reference_model;
  build(reference_model, GetParam());
  kit::DenseAssembly dense(reference_model);
  const model::State state = kit::random_state(reference_model, 3);
  const Stencil stencil = Stencil::midpoint(0.1);
  dense.prepare(state, stencil);
  const Eigen::MatrixXd tangent = dense.tangent(state, stencil);

  model::Model model;
  build(model, GetParam());
  Ledger ledger;
  System system(model, parallel::Comm(), ledger);
  system.prepare(state, stencil);
  system.evaluate(state, stencil, Want::residual_and_tangent);
  Eigen::SparseMatrix<double> few(tangent.rows(), tangent.cols());
  few.insert(0, tangent.cols() - 1) = 2.0;
  few.insert(tangent.rows() - 1, 1) = -3.0;

  const Rows& rows = system.layout().rows();
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(tangent.cols(), -1.0, 2.0);
  Vector mine(rows), product(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) mine.values()[i] = x[rows.global(i)];
  const auto expect_product = [&](const Matrix& matrix, const Eigen::VectorXd& expected) {
    for (int twice = 0; twice < 2; ++twice) {
      product.fill(7.0);
      matrix.multiply(mine, product);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_NEAR(product.values()[i], expected[rows.global(i)],
                    1e-13 * tangent.cwiseAbs().maxCoeff());
      }
    }
  };
  expect_product(*system.matrix(), tangent * x);
  expect_product(Matrix(rows, few), few * x);
}

TEST_P(SystemTest, MoveAndSynchroniseGiveTheSameStateOnAllRanks) {
  model::Model model;
  build(model, GetParam());
  Ledger ledger;
  System system(model, parallel::Comm(), ledger);
  model::State state = model.initial_state();
  Eigen::VectorXd whole(model.unknowns().num_unknowns());
  for (int i = 0; i < whole.size(); ++i) whole[i] = 0.01 * std::sin(1.0 + i);
  Vector increment(system.layout().rows());
  const auto values = increment.values();
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = whole[increment.rows().global(i)];
  }
  system.move(state, increment, 1.0);
  system.synchronise(state);

  model::Model expected_model;
  build(expected_model, GetParam());
  const kit::DenseAssembly dense(expected_model);
  model::State expected = expected_model.initial_state();
  dense.move(expected, whole);
  for (std::size_t i = 0; i < state.next.size(); ++i) {
    EXPECT_DOUBLE_EQ(state.next[i], expected.next[i]);
  }
  for (std::size_t i = 0; i < state.multipliers.size(); ++i) {
    EXPECT_DOUBLE_EQ(state.multipliers[i], expected.multipliers[i]);
  }
}

TEST_P(SystemTest, GatheredStateHasAllNodesOnRankZero) {
  model::Model model;
  build(model, GetParam());
  Ledger ledger;
  System system(model, parallel::Comm(), ledger);
  const model::State expected = kit::random_state(model, 3);
  model::State state = expected;
  system.forget_others(state);
  const model::State whole = system.gather(state);
  if (!system.comm().is_root()) return;
  EXPECT_TRUE(std::ranges::equal(whole.next, expected.next));
  EXPECT_TRUE(std::ranges::equal(whole.velocity, expected.velocity));
  EXPECT_EQ(whole.multipliers, expected.multipliers);
}

// What no row needs is zero, and nothing changes by that.
TEST_P(SystemTest, EvaluatesTheSameWithoutNodesAndItemsOfOthers) {
  model::Model model;
  build(model, GetParam());
  Ledger ledger;
  System system(model, parallel::Comm(), ledger);
  const Stencil stencil = Stencil::midpoint(0.1);
  model::State state = kit::random_state(model, 3);
  const auto residual = [&] {
    system.prepare(state, stencil);
    system.evaluate(state, stencil, Want::residual_and_tangent);
    const auto values = system.residual().values();
    return std::vector<double>(values.begin(), values.end());
  };
  const std::vector<double> before = residual();
  const double energy = system.strain_energy(state.next);
  const System::Motions motions = motions_of(system, state);
  system.forget_others(state);
  system.forget_other_items();
  EXPECT_EQ(residual(), before);
  EXPECT_EQ(system.strain_energy(state.next), energy);
  EXPECT_EQ(motions_of(system, state), motions);
  const auto others = static_cast<std::size_t>(model.nodes().size()) - system.owned_nodes().size();
  if (system.comm().size() == 1) {
    EXPECT_EQ(others, 0U);
    return;
  }
  const auto& batch = model::elements<kit::SpringLink>(model, "Spring link");
  int here = 0;
  for (int item = 0; item < batch.size(); ++item) {
    const bool is_here = system.needs(item) && system.needs(item + 1);
    here += is_here;
    if (!is_here) {
      EXPECT_THROW(batch.element(item), InternalError);
    }
  }
  EXPECT_LT(here, batch.size());
  int zeros = 0;
  for (int node = 0; node < model.nodes().size(); ++node) {
    const bool is_zero = model::NodeTable::slots(state.next, node).isZero(0.0);
    EXPECT_EQ(is_zero, !system.needs(node));
    zeros += is_zero;
  }
  EXPECT_GT(zeros, 0);
}

TEST_P(SystemTest, SnapshotsTakeNodesAndMotionsThereAndBack) {
  model::Model model;
  build(model, GetParam());
  Ledger ledger;
  System system(model, parallel::Comm(), ledger);
  const model::State expected = kit::random_state(model, 3);
  for (const Snapshot::Use use : {Snapshot::Use::files, Snapshot::Use::memory}) {
    model::State state = expected;
    if (use == Snapshot::Use::files) system.forget_others(state);
    const System::Motions motions = motions_of(system, expected);
    Snapshot snapshot(use);
    system.save(state, snapshot);
    system.save(motions, "motions", snapshot);
    model::State restored = model.initial_state();
    system.restore(snapshot, restored);
    EXPECT_TRUE(std::ranges::equal(restored.next, expected.next));
    EXPECT_TRUE(std::ranges::equal(restored.velocity, expected.velocity));
    EXPECT_EQ(system.restore_motions(snapshot, "motions"), motions);
  }
}

TEST_P(SystemTest, EnergyCountsEachElementOnce) {
  model::Model model;
  build(model, GetParam());
  Ledger ledger;
  System system(model, parallel::Comm(), ledger);
  const model::State state = kit::random_state(model, 5);
  double expected = 0.0;
  const auto& batch = model::elements<kit::SpringLink>(model, "Spring link");
  for (int item = 0; item < batch.size(); ++item) {
    Slots<8> q;
    q << model::NodeTable::slots(state.next, item), model::NodeTable::slots(state.next, item + 1);
    Vec6 strain;
    batch.element(item).strain(0, q, strain);
    expected += batch.element(item).energy(0, strain);
  }
  EXPECT_NEAR(system.strain_energy(state.next), expected, 1e-12 * expected);
}

TEST(FirstColumns, AreThoseOfRowsWithoutGaps) {
  const std::vector<std::size_t> row_begin = {0, 3, 5, 5, 6};
  const std::vector<int> column_of = {4, 5, 6, 1, 3, 7};
  EXPECT_EQ(first_columns(row_begin, column_of), (std::vector<int>{4, -1, -1, 7}));
}

TEST_P(SystemTest, TheRowOfTheLargestForceIsKnown) {
  model::Model model;
  kit::add_chain(model, 40);
  model.freeze(GetParam());
  Ledger ledger;
  System system(model, parallel::Comm(), ledger);
  EXPECT_EQ(system.largest_force_row(), -1);
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    const model::State state = kit::random_state(model, seed);
    system.prepare(state, Stencil::statics());
    const Evaluation found = system.evaluate(state, Stencil::statics(), Want::residual);
    const int row = system.largest_force_row();
    ASSERT_GE(row, 0);
    ASSERT_LT(row, system.layout().num_node_rows());
    const auto residual = std::as_const(system.residual()).values();
    const double largest = std::abs(residual[static_cast<std::size_t>(row)]);
    EXPECT_EQ(system.comm().max(largest), found.force_residual);
  }
}

// Largest residual of all force rows over the bound on rounding of its row.
double rounding_share(System& system, const model::State& state) {
  system.prepare(state, Stencil::statics());
  const Evaluation found = system.evaluate(state, Stencil::statics(), Want::residual_and_tangent);
  return check_rounding(system, {state.prev, state.next, state.multipliers, state.own}, 0.0,
                        found.force_scale, 1e3)
      .share;
}

void shift(model::State& state, const Vec3& distance) {
  for (std::size_t i = 0; i < state.next.size(); ++i) {
    if (i % 12 >= 3) continue;
    state.prev[i] += distance[static_cast<int>(i % 12)];
    state.next[i] += distance[static_cast<int>(i % 12)];
  }
}

TEST_P(SystemTest, RoundingMayExplainMoreFarFromTheOrigin) {
  model::Model model;
  build(model, GetParam());
  Ledger ledger;
  System system(model, parallel::Comm(), ledger);
  model::State state = kit::random_state(model, 7);
  const double near = rounding_share(system, state);
  shift(state, 1e4 * model.length() * Vec3(1.0, 0.8, -0.9));
  EXPECT_LT(rounding_share(system, state), 1e-2 * near);
}

TEST_P(SystemTest, RoundingOfARigidMotionStaysBelowItsBound) {
  model::Model model;
  kit::add_chain(model, 12);
  model.freeze(GetParam());
  Ledger ledger;
  System system(model, parallel::Comm(), ledger);
  const Mat3 turn = Eigen::AngleAxisd(2.0, Vec3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  for (const double distance : {0.0, 1e3, 1e6}) {
    model::State state = model.initial_state();
    for (int node = 0; node < model.nodes().size(); ++node) {
      for (model::Coordinates* q : {&state.prev, &state.next}) {
        model::NodeTable::slots(*q, node) = turn * model::NodeTable::slots(*q, node);
      }
    }
    shift(state, distance * Vec3(1.0, -0.7, 0.4));
    const double share = rounding_share(system, state);
    EXPECT_LT(share, 1.0) << distance;
    EXPECT_GT(share, 1e-3) << distance << ": the bound says nothing";
  }
}

TEST_P(SystemTest, StiffRowsDoNotExcuseSoftOnes) {
  model::Model model;
  kit::add_chain(model, 12);
  model::NodeSlots slots = model::NodeTable::slots(model.nodes().reference(), 12);
  slots.col(0) += Vec3::UnitX();
  const int last = model.nodes().add(slots);
  Slots<8> link;
  link << model::NodeTable::slots(model.nodes().reference(), 12), slots;
  model::elements<kit::SpringLink>(model, "Spring link")
      .add(kit::SpringLink(link, 1e12), {12, last});
  model.freeze(GetParam());
  Ledger ledger;
  System system(model, parallel::Comm(), ledger);
  model::State state = model.initial_state();
  ASSERT_LT(rounding_share(system, state), 1.0);
  model::NodeTable::slots(state.next, 0)(0, 0) +=
      1e-8;  // a force of 1e-6 N; 1e-3 N beside the stiff
  EXPECT_GT(rounding_share(system, state), 1e3);
}

INSTANTIATE_TEST_SUITE_P(Forms, SystemTest, ::testing::Values(Form::null_space, Form::multipliers),
                         [](const auto& form) {
                           return form.param == Form::null_space ? "NullSpace" : "Multipliers";
                         });

}  // namespace
}  // namespace culm::assembly
