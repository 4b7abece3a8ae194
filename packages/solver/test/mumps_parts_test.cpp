#include "../src/mumps_parts.hpp"

#include "../src/mumps_solver.hpp"
#include "spread_system.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace culm::solver {
namespace {

// Nodes of a square sheet, each coupled with the eight around it.
Skeleton sheet(int side) {
  Skeleton s{"sheet", {}, std::vector<int>(static_cast<std::size_t>(side) * side, 6), {}};
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const int here = i * side + j;
      if (j + 1 < side) s.edges.emplace_back(here, here + 1);
      for (int k = std::max(0, j - 1); i + 1 < side && k <= std::min(side - 1, j + 1); ++k) {
        s.edges.emplace_back(here, here + side - j + k);
      }
    }
  }
  return s;
}

Skeleton strip() {
  return solver::chain(60, [](int) { return 6; });
}

void make_symmetric(SpreadSystem& A) {
  A.dense = (A.dense + A.dense.transpose()).eval();
  A.refresh();
}

int negative_eigenvalues(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(A, Eigen::EigenvaluesOnly);
  return static_cast<int>((eigen.eigenvalues().array() < 0.0).count());
}

TEST(MumpsParts, SolvesAndKnowsTheDeterminant) {
  std::vector<Skeleton> all = skeletons();
  all.push_back(sheet(8));
  for (const Skeleton& s : all) {
    for (const auto& owner_of : {in_pieces, in_turn, all_on_the_last}) {
      for (const Symmetry symmetry : {Symmetry::none, Symmetry::symmetric}) {
        SpreadSystem A(s, owner_of);
        if (symmetry == Symmetry::symmetric) make_symmetric(A);
        MumpsParts parts(assembly::tpetra(*A.matrix), A.comm);
        if (!parts.factor(symmetry)) {  // only joints do not stand alone
          EXPECT_FALSE(s.hollow.empty() || A.comm.size() == 1) << s.name << s.sizes.size();
          continue;
        }
        const Eigen::FullPivLU<Eigen::MatrixXd> exact(A.dense);
        const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
        Vector found(A.rows);
        parts.solve(A.distribute(A.dense * x), found);
        EXPECT_LT(A.difference(found, x), 1e-10 / exact.rcond()) << s.name << s.sizes.size();
        const Determinant determinant = parts.determinant();
        EXPECT_EQ(determinant.sign, exact.determinant() > 0.0 ? 1 : -1) << s.name;
        EXPECT_NEAR(determinant.log_size, std::log(std::abs(exact.determinant())), 1e-8) << s.name;
        if (symmetry == Symmetry::symmetric) {
          EXPECT_EQ(determinant.negative, negative_eigenvalues(A.dense)) << s.name;
        } else {
          EXPECT_FALSE(determinant.negative);
        }
      }
    }
  }
}

TEST(MumpsParts, SymmetryMayComeAndGo) {
  const Skeleton s = sheet(5);
  SpreadSystem A(s, in_pieces);
  MumpsParts parts(assembly::tpetra(*A.matrix), A.comm);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
  const auto error = [&](Symmetry symmetry) {
    Vector found(A.rows);
    EXPECT_TRUE(parts.factor(symmetry));
    parts.solve(A.distribute(A.dense * x), found);
    return A.difference(found, x);
  };
  EXPECT_LT(error(Symmetry::none), 1e-9);
  make_symmetric(A);
  EXPECT_LT(error(Symmetry::symmetric), 1e-9);
  A.dense(3, 4) += 1.0;
  A.refresh();
  EXPECT_LT(error(Symmetry::none), 1e-9);
}

// So that a run goes on bit by bit.
TEST(MumpsParts, RoundingIsTheSameEachTime) {
  const Skeleton s = sheet(8);
  SpreadSystem A(s, in_pieces);
  make_symmetric(A);
  const Vector b = A.distribute(Eigen::VectorXd::LinSpaced(s.rows(), 1.0, 2.0));
  std::vector<double> first;
  for (int i = 0; i < 3; ++i) {
    MumpsParts parts(assembly::tpetra(*A.matrix), A.comm);
    Vector x(A.rows);
    for (int again = 0; again <= i; ++again) ASSERT_TRUE(parts.factor(Symmetry::symmetric));
    parts.solve(b, x);
    if (i == 0) first.assign(x.values().begin(), x.values().end());
    EXPECT_TRUE(std::ranges::equal(x.values(), first));
  }
}

TEST(MumpsParts, WorkIsWhatEachRankHasAndTheRootAfterIt) {
  const SpreadSystem A(sheet(12), in_pieces);
  const auto matrix = assembly::tpetra(*A.matrix);
  const double whole = order_rows(*matrix, A.comm).fill.operations;
  const double parts = MumpsParts(matrix, A.comm).operations();
  if (A.comm.size() == 1) {
    EXPECT_EQ(parts, whole);
  } else {
    EXPECT_GT(parts, whole / A.comm.size());
    EXPECT_LT(parts, whole);
  }
}

std::unique_ptr<LinearSolver> make_shared(const SpreadSystem& A) {
  const auto matrix = assembly::tpetra(*A.matrix);
  return make_shared_mumps(matrix, order_rows(*matrix, A.comm), A.comm);
}

bool is_in_parts(const LinearSolver& solver) {
  return solver.remark().find("unknowns between them") != std::string::npos;
}

TEST(SharedMumps, TakesPartsWhereTheyAreLessWork) {
  // a long strip has small ends, and every second node is between others
  EXPECT_TRUE(is_in_parts(*make_shared({strip(), in_pieces})));
  const SpreadSystem between(sheet(10), in_turn);
  EXPECT_EQ(is_in_parts(*make_shared(between)), between.comm.size() == 1);
}

TEST(SharedMumps, APartThatCannotStandAloneIsFactoredWithTheOthers) {
  const Skeleton s = strip();
  SpreadSystem A(s, in_pieces);
  const int ranks = A.comm.size();
  if (ranks > 1) {  // the last node of the first part hangs on the next part alone
    const int node = 6 * (60 / ranks - 1);
    A.dense.middleRows(node, 6).leftCols(node + 6).setZero();
    A.dense.middleCols(node, 6).topRows(node + 6).setZero();
    A.refresh();
  }
  const auto solver = make_shared(A);
  ASSERT_TRUE(is_in_parts(*solver));
  const Eigen::FullPivLU<Eigen::MatrixXd> exact(A.dense);
  ASSERT_TRUE(exact.isInvertible());
  ASSERT_TRUE(solver->factor());
  EXPECT_EQ(is_in_parts(*solver), ranks == 1) << solver->remark();
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
  Vector found(A.rows);
  EXPECT_LT(solver->solve(A.distribute(A.dense * x), found).size, 1e-12);
  EXPECT_LT(A.difference(found, x), 1e-10 / exact.rcond());
}

TEST(SharedMumps, ASingularMatrixLeavesTheParts) {
  const Skeleton s = strip();
  SpreadSystem A(s, in_pieces);
  const Eigen::MatrixXd sound = A.dense;
  A.dense.row(7).setZero();
  A.refresh();
  const auto solver = make_shared(A);
  EXPECT_FALSE(solver->factor());
  Vector v(A.rows);
  EXPECT_LT(solver->weakest_direction(v), 1e-14);
  A.dense = sound;
  A.refresh();
  ASSERT_TRUE(solver->factor());
  EXPECT_TRUE(is_in_parts(*solver));
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
  Vector found(A.rows);
  EXPECT_LT(solver->solve(A.distribute(A.dense * x), found).size, 1e-12);
  EXPECT_LT(A.difference(found, x), 1e-8);
}

}  // namespace
}  // namespace culm::solver
