#include "../src/substructured_solver.hpp"

#include "skeletons.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

namespace culm::solver {
namespace {

using assembly::Matrix;
using assembly::Rows;

// A matrix with the pattern of a skeleton, whose blocks are spread over the ranks.
class SpreadSystem {
 public:
  using OwnerOf = std::function<int(int block, int blocks, int ranks)>;

  SpreadSystem(const Skeleton& s, const OwnerOf& owner_of, unsigned seed = 1)
      : dense(random_values(s, seed)),
        rows(own_rows(s, owner_of, comm), comm),
        matrix(std::make_shared<Matrix>(rows, with_pattern(s, dense))) {}

  // The values again, after they have been changed.
  void refresh() const {
    std::size_t k = 0;
    matrix->each_entry([&](std::size_t row, long long column, double) {
      matrix->values()[k++] = dense(rows.global(row), column);
    });
  }

  Vector distribute(const Eigen::VectorXd& whole) const {
    Vector v(rows);
    for (std::size_t i = 0; i < rows.size(); ++i) v.values()[i] = whole[rows.global(i)];
    return v;
  }
  double difference(const Vector& v, const Eigen::VectorXd& whole) const {
    Vector d = distribute(whole);
    d.update(1.0, v, -1.0);
    return d.largest();
  }

  parallel::Comm comm;
  Eigen::MatrixXd dense;
  Rows rows;
  std::shared_ptr<Matrix> matrix;

 private:
  static std::vector<long long> own_rows(const Skeleton& s, const OwnerOf& owner_of,
                                         const parallel::Comm& comm) {
    std::vector<long long> mine;
    const std::vector<int> block_of = s.block_of_row();
    for (int row = 0; row < s.rows(); ++row) {
      const int blocks = static_cast<int>(s.sizes.size());
      if (owner_of(block_of[row], blocks, comm.size()) == comm.rank()) mine.push_back(row);
    }
    return mine;
  }
  static Eigen::SparseMatrix<double> with_pattern(const Skeleton& s, const Eigen::MatrixXd& dense) {
    const std::vector<int> block_of = s.block_of_row();
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < s.rows(); ++i) {
      for (int j = 0; j < s.rows(); ++j) {
        if (s.couples(block_of[i], block_of[j])) entries.emplace_back(i, j, dense(i, j));
      }
    }
    Eigen::SparseMatrix<double> sparse(s.rows(), s.rows());
    sparse.setFromTriplets(entries.begin(), entries.end());
    return sparse;
  }
};

int in_pieces(int block, int blocks, int ranks) { return block * ranks / blocks; }
int in_turn(int block, int, int ranks) { return block % ranks; }
int all_on_the_last(int, int, int ranks) { return ranks - 1; }

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
