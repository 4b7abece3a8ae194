#include "../src/substructured_solver.hpp"

#include "spread_system.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace culm::solver {
namespace {

TEST(SubstructuredSolver, SolvesAndKnowsTheDeterminant) {
  for (const Skeleton& s : skeletons()) {
    for (const auto& owner_of : {in_pieces, in_turn, all_on_the_last}) {
      const SpreadSystem A(s, owner_of);
      const auto solver = make_substructured(A.matrix, A.comm);
      ASSERT_TRUE(solver->factor()) << s.name << " of " << s.sizes.size();
      const Eigen::FullPivLU<Eigen::MatrixXd> exact(A.dense);
      const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
      Vector found(A.rows);
      EXPECT_TRUE(solver->solve(A.distribute(A.dense * x), found).is_sound());
      EXPECT_LT(A.difference(found, x), 1e-10 / exact.rcond()) << s.name << s.sizes.size();
      ASSERT_TRUE(solver->factor_for(A.distribute(A.dense * x)));
      Vector begun(A.rows);
      EXPECT_TRUE(solver->solve(A.distribute(A.dense * x), begun).is_sound());
      EXPECT_LT(A.difference(begun, x), 1e-10 / exact.rcond()) << s.name << s.sizes.size();
      const double determinant = exact.determinant();
      EXPECT_EQ(solver->determinant().sign, determinant > 0.0 ? 1 : -1) << s.name;
      EXPECT_NEAR(solver->determinant().log_size, std::log(std::abs(determinant)), 1e-9) << s.name;
    }
  }
}

bool is_whole(const LinearSolver& solver) {
  return solver.remark().find("factorisations on one") != std::string::npos;
}

TEST(SubstructuredSolver, PartsOfChainsAndTreesStandAlone) {
  for (const auto& make : {chain, tree, loop}) {
    const SpreadSystem A(make(40, [](int) { return 6; }), in_pieces);
    const auto solver = make_substructured(A.matrix, A.comm);
    ASSERT_TRUE(solver->factor());
    EXPECT_FALSE(is_whole(*solver)) << solver->remark();
  }
}

// Each node has forces of its own, as those that keep directors rigid.
TEST(SubstructuredSolver, ForcesOnANodeBetweenPartsStayWithIt) {
  constexpr int nodes = 20;
  Skeleton s = chain(nodes, [](int) { return 12; });
  for (int node = 0; node < nodes; ++node) {
    s.sizes.push_back(6);
    s.hollow.push_back(nodes + node);
    s.edges.emplace_back(node, nodes + node);
  }
  const SpreadSystem A(
      s, [](int block, int blocks, int ranks) { return (block % nodes) * ranks / (blocks / 2); });
  const auto solver = make_substructured(A.matrix, A.comm);
  ASSERT_TRUE(solver->factor());
  EXPECT_FALSE(is_whole(*solver)) << solver->remark();
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
  Vector found(A.rows);
  EXPECT_TRUE(solver->solve(A.distribute(A.dense * x), found).is_sound());
  EXPECT_LT(A.difference(found, x), 1e-8);
}

// Two bodies on the first rank that a joint on the second holds to each other and to the rest.
TEST(SubstructuredSolver, APartThatCannotStandAloneIsFactoredWithTheOthers) {
  const Skeleton s = bodies(20, false);
  SpreadSystem A(s, [](int block, int blocks, int ranks) {
    return block < blocks / 2 ? 0 : ranks - 1;  // all joints are on the last rank
  });
  for (int body = 0; body < 4; ++body) A.dense.block(6 * body, 6 * body, 6, 6).setZero();
  for (int body = 0; body < 4; ++body) {  // as stiff as the joint leaves it free
    A.dense.block(6 * body, 6 * body, 6, 6).diagonal().tail(5).setOnes();
  }
  A.refresh();
  const auto solver = make_substructured(A.matrix, A.comm);
  ASSERT_TRUE(solver->factor());
  EXPECT_EQ(is_whole(*solver), A.comm.size() > 1) << solver->remark();
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
  Vector found(A.rows);
  EXPECT_LT(solver->solve(A.distribute(A.dense * x), found).size, 1e-12);
}

TEST(SubstructuredSolver, FactorsAfterASingularMatrixWhoseDirectionIsFound) {
  const Skeleton s = chain(30, [](int) { return 6; });
  SpreadSystem A(s, in_pieces);
  A.dense.row(7).setZero();
  A.refresh();
  const auto solver = make_substructured(A.matrix, A.comm);
  EXPECT_FALSE(solver->factor());
  Vector v(A.rows);
  EXPECT_LT(solver->weakest_direction(v), 1e-14);
  EXPECT_NEAR(v.largest(), 1.0, 1e-12);
  A.dense = random_values(s, 5);
  A.refresh();
  ASSERT_TRUE(solver->factor());
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
  Vector found(A.rows);
  EXPECT_LT(solver->solve(A.distribute(A.dense * x), found).size, 1e-12);
  EXPECT_LT(A.difference(found, x), 1e-8);
}

TEST(SubstructuredSolver, GoesOnBitByBitWithThePivotsOfAnother) {
  const Skeleton s = bodies(24, true);
  SpreadSystem A(s, in_pieces);
  const auto solver = make_substructured(A.matrix, A.comm);
  ASSERT_TRUE(solver->factor());
  const std::vector<int> pivots = solver->pivots();
  EXPECT_EQ(pivots.empty(), !A.comm.is_root());
  A.dense = random_values(s, 2);
  A.refresh();
  const auto resumed = make_substructured(A.matrix, A.comm);
  EXPECT_TRUE(resumed->set_pivots(pivots));
  ASSERT_TRUE(solver->factor() && resumed->factor());
  const Vector b = A.distribute(Eigen::VectorXd::LinSpaced(s.rows(), 1.0, 2.0));
  Vector x(A.rows), y(A.rows);
  solver->solve(b, x);
  resumed->solve(b, y);
  EXPECT_TRUE(std::ranges::equal(x.values(), y.values()));
  EXPECT_EQ(solver->pivots(), resumed->pivots());
}

TEST(SubstructuredSolver, RestoredPivotsAreThoseThatWereRemembered) {
  const Skeleton s = bodies(24, false);
  SpreadSystem A(s, in_pieces);
  const auto solver = make_substructured(A.matrix, A.comm);
  ASSERT_TRUE(solver->factor());
  const std::vector<int> before = solver->pivots();
  solver->remember_pivots();
  const Eigen::MatrixXd sound = A.dense;
  A.dense.topRows(s.rows() / 2) *= 0.0;  // no factors at all
  A.refresh();
  EXPECT_FALSE(solver->factor());
  EXPECT_EQ(solver->pivots(), before);
  solver->restore_pivots();
  EXPECT_EQ(solver->pivots(), before);
  A.dense = sound;
  A.refresh();
  EXPECT_TRUE(solver->factor());
}

TEST(SubstructuredSolver, PivotsOfAnotherSizeAreRefused) {
  const SpreadSystem A(chain(12, [](int) { return 6; }), in_pieces);
  const auto solver = make_substructured(A.matrix, A.comm);
  const bool root = A.comm.is_root();
  const auto numbers = [&](std::vector<int> all) { return root ? all : std::vector<int>(); };
  EXPECT_FALSE(solver->set_pivots(numbers({-2, A.comm.size() + 1, 0})));
  EXPECT_FALSE(solver->set_pivots(numbers({-2, A.comm.size(), 700})));
  EXPECT_FALSE(solver->set_pivots(numbers({-2})));
  EXPECT_FALSE(solver->set_pivots(numbers({5, 4, 3})));
  EXPECT_TRUE(solver->set_pivots({}));
  EXPECT_TRUE(solver->factor());
}

}  // namespace
}  // namespace culm::solver
