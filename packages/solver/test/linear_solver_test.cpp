#include <culm/parallel/comm.hpp>
#include <culm/solver/linear_solver.hpp>

#include "../src/one_factorisation.hpp"
#include "../src/symmetry_check.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace culm::solver {
namespace {

using assembly::Matrix;
using assembly::Rows;

// An unsymmetric matrix with a band and some far entries.
Eigen::MatrixXd band_with_far_entries(int size = 60) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < size; ++i) {
    for (int j : {i - 2, i - 1, i, i + 1, (7 * i + 3) % size}) {
      if (j >= 0 && j < size) dense(i, j) += std::sin(1.0 + 3.0 * i - 2.0 * j) + 4.0 * (i == j);
    }
  }
  return dense;
}

// Row i of a matrix lives on rank i % size, so no rank has a contiguous piece.
class ScatteredSystem {
 public:
  explicit ScatteredSystem(Eigen::MatrixXd dense = band_with_far_entries())
      : dense_(std::move(dense)),
        rows_(scatter(size(), comm_), comm_),
        matrix_(std::make_shared<Matrix>(rows_, with_diagonal(dense_))) {}

  int size() const { return static_cast<int>(dense_.rows()); }
  const Eigen::MatrixXd& dense() const { return dense_; }
  const Rows& rows() const { return rows_; }
  const std::shared_ptr<Matrix>& matrix() const { return matrix_; }
  const parallel::Comm& comm() const { return comm_; }

  // f(global row, global column, value)
  template <class Change>
  void change(const Change& f) const {
    std::size_t k = 0;
    matrix_->each_entry([&](std::size_t row, long long column, double) {
      f(rows_.global(row), column, matrix_->values()[k++]);
    });
  }

  void scale_diagonal(double factor) {
    change([&](long long row, long long column, double& value) {
      if (row == column) value *= factor;
    });
    dense_.diagonal() *= factor;
  }

  void set_entry(long long row, long long column, double wanted) const {
    change([&](long long i, long long j, double& value) {
      if (i == row && j == column) value = wanted;
    });
  }

  Vector distribute(const Eigen::VectorXd& whole) const {
    Vector v(rows_);
    for (std::size_t i = 0; i < rows_.size(); ++i) v.values()[i] = whole[rows_.global(i)];
    return v;
  }
  // largest difference to a whole vector on any rank
  double difference(const Vector& v, const Eigen::VectorXd& whole) const {
    Vector d = distribute(whole);
    d.update(1.0, v, -1.0);
    return d.largest();
  }

 private:
  static std::vector<long long> scatter(int size, const parallel::Comm& comm) {
    std::vector<long long> mine;
    for (int i = comm.rank(); i < size; i += comm.size()) mine.push_back(i);
    return mine;
  }
  static Eigen::SparseMatrix<double> with_diagonal(const Eigen::MatrixXd& dense) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < dense.rows(); ++i) {
      for (int j = 0; j < dense.cols(); ++j) {
        if (dense(i, j) != 0.0 || i == j) entries.emplace_back(i, j, dense(i, j));
      }
    }
    Eigen::SparseMatrix<double> sparse(dense.rows(), dense.cols());
    sparse.setFromTriplets(entries.begin(), entries.end());
    return sparse;
  }

  parallel::Comm comm_;
  Eigen::MatrixXd dense_;
  Rows rows_;
  std::shared_ptr<Matrix> matrix_;
};

std::unique_ptr<LinearSolver> make(const std::string& name, const ScatteredSystem& system) {
  if (name == "MUMPS on all ranks") return make_mumps(system.matrix(), system.comm());
  return choose_linear_solver(name, system.matrix(), system.comm()).solver;
}

class EachLinearSolver : public testing::TestWithParam<std::string> {
 protected:
  ScatteredSystem system;
};
INSTANTIATE_TEST_SUITE_P(LinearSolver, EachLinearSolver,
                         testing::Values("Block LU", "KLU2", "MUMPS", "MUMPS on all ranks"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::erase(name, ' ');
                           return name;
                         });

TEST_P(EachLinearSolver, SolvesUnsymmetricSystemsOnAnyNumberOfRanks) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(system.size(), -1.0, 2.0);
  const auto solver = make(GetParam(), system);
  ASSERT_TRUE(solver->factor());
  Vector solution(system.rows());
  EXPECT_LT(solver->solve(system.distribute(system.dense() * x), solution).size, 1e-14);
  EXPECT_LT(system.difference(solution, x), 1e-12);
}

// A solution may begin while its matrix is factored; the ones that follow know nothing of it.
TEST_P(EachLinearSolver, MayBeginASolutionWhileItFactors) {
  const auto solver = make(GetParam(), system);
  const Eigen::VectorXd first = Eigen::VectorXd::LinSpaced(system.size(), -1.0, 2.0);
  const Eigen::VectorXd second = Eigen::VectorXd::LinSpaced(system.size(), 3.0, 1.0);
  for (const double factor : {1.0, 2.0}) {
    system.scale_diagonal(factor);
    Vector x(system.rows()), y(system.rows());
    const Vector b = system.distribute(system.dense() * first);
    ASSERT_TRUE(solver->factor_for(b));
    EXPECT_LT(solver->solve(b, x).size, 1e-12);
    EXPECT_LT(system.difference(x, first), 1e-10);
    EXPECT_LT(solver->solve(system.distribute(system.dense() * second), y).size, 1e-12);
    EXPECT_LT(system.difference(y, second), 1e-10);
    ASSERT_TRUE(solver->factor());
    EXPECT_LT(solver->solve(b, y).size, 1e-12);
    EXPECT_LT(system.difference(y, first), 1e-10);
  }
}

TEST_P(EachLinearSolver, KnowsTheDeterminant) {
  for (const int exchanged : {0, 1, 7}) {
    Eigen::MatrixXd dense = band_with_far_entries(31);
    for (int i = 0; i < exchanged; ++i) dense.row(3 * i).swap(dense.row(30 - 2 * i));
    dense.row(5) *= -1e3;
    const ScatteredSystem other(dense);
    const auto solver = make(GetParam(), other);
    ASSERT_TRUE(solver->factor());
    const Determinant found = solver->determinant();
    const double exact = dense.determinant();
    EXPECT_EQ(found.sign, exact > 0.0 ? 1 : -1) << exchanged;
    EXPECT_NEAR(found.log_size, std::log(std::abs(exact)), 1e-10);
  }
}

TEST_P(EachLinearSolver, SymmetricMatricesNeedNotBeDefinite) {
  for (const int negative : {0, 1, 8}) {
    Eigen::MatrixXd dense = band_with_far_entries();
    dense = (dense + dense.transpose()).eval();
    for (int i = 0; i < negative; ++i) dense(7 * i, 7 * i) *= -1.0;
    const ScatteredSystem symmetric(dense);
    const auto solver = make(GetParam(), symmetric);
    ASSERT_TRUE(solver->factor());
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(symmetric.size(), -1.0, 2.0);
    Vector solution(symmetric.rows());
    EXPECT_LT(solver->solve(symmetric.distribute(dense * x), solution).size, 1e-14);
    EXPECT_LT(symmetric.difference(solution, x), 1e-12);
    const double exact = dense.determinant();
    EXPECT_EQ(solver->determinant().sign, exact > 0.0 ? 1 : -1) << negative;
    EXPECT_NEAR(solver->determinant().log_size, std::log(std::abs(exact)), 1e-10);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(dense, Eigen::EigenvaluesOnly);
    const auto below = (modes.eigenvalues().array() < 0.0).count();
    EXPECT_EQ(solver->determinant().negative.value_or(static_cast<int>(below)), below);
  }
}

TEST(BlockLuSolver, CountsNegativeEigenvalues) {
  Eigen::MatrixXd dense = band_with_far_entries();
  dense = (dense + dense.transpose()).eval();
  dense(7, 7) *= -1.0;
  dense(21, 21) *= -1.0;
  const ScatteredSystem symmetric(dense);
  const auto solver = make("Block LU", symmetric);
  ASSERT_TRUE(solver->factor());
  EXPECT_EQ(solver->determinant().negative, 2);
}

// One entry loses its mirror image, little or entirely, and finds it again.
TEST_P(EachLinearSolver, SymmetryMayComeAndGo) {
  Eigen::MatrixXd dense = band_with_far_entries();
  dense = (dense + dense.transpose()).eval();
  const ScatteredSystem other(dense);
  const auto solver = make(GetParam(), other);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(other.size(), -1.0, 2.0);
  Vector solution(other.rows());
  for (const double factor : {1.0, 1.0 + 1e-14, 1.0 + 1e-9, -2.0, 1.0}) {
    Eigen::MatrixXd changed = dense;
    changed(31, 30) *= factor;
    other.set_entry(31, 30, changed(31, 30));
    ASSERT_TRUE(solver->factor());
    EXPECT_LT(solver->solve(other.distribute(changed * x), solution).size, 1e-14) << factor;
    EXPECT_LT(other.difference(solution, x), 1e-12) << factor;
    const double exact = changed.determinant();
    EXPECT_EQ(solver->determinant().sign, exact > 0.0 ? 1 : -1) << factor;
  }
}

TEST_P(EachLinearSolver, SingularSymmetricMatrixIsNoticed) {
  Eigen::MatrixXd dense = band_with_far_entries();
  dense = (dense + dense.transpose()).eval();
  dense.row(5).setZero();
  dense.col(5).setZero();
  const ScatteredSystem free(dense);
  const auto solver = make(GetParam(), free);
  Vector x(free.rows());
  const Vector b = free.distribute(Eigen::VectorXd::Ones(free.size()));
  EXPECT_TRUE(!solver->factor() || !solver->solve(b, x).is_sound());
}

TEST_P(EachLinearSolver, NewValuesReplaceOldFactors) {
  const auto solver = make(GetParam(), system);
  ASSERT_TRUE(solver->factor());
  for (double& value : system.matrix()->values()) value *= 2.0;
  ASSERT_TRUE(solver->factor());
  const Eigen::VectorXd x = Eigen::VectorXd::Ones(system.size());
  Vector solution(system.rows());
  solver->solve(system.distribute(system.dense() * x), solution);
  EXPECT_LT(system.difference(solution, 0.5 * x), 1e-12);
}

TEST_P(EachLinearSolver, TheSameValuesAreFactoredAsBefore) {
  const auto solver = make(GetParam(), system);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(system.size(), -1.0, 2.0);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(solver->factor());
    Vector solution(system.rows());
    solver->solve(system.distribute(system.dense() * x), solution);
    EXPECT_LT(system.difference(solution, x), 1e-12);
  }
}

// Signs alone, of which two undo each other in most sums.
TEST_P(EachLinearSolver, OtherSignsAreOtherValues) {
  const auto solver = make(GetParam(), system);
  ASSERT_TRUE(solver->factor());
  Eigen::MatrixXd other = system.dense();
  for (const int row : {3, 7}) {
    other(row, row) = -other(row, row);
    system.set_entry(row, row, other(row, row));
  }
  ASSERT_TRUE(solver->factor());
  const Eigen::VectorXd x = Eigen::VectorXd::Ones(system.size());
  Vector solution(system.rows());
  solver->solve(system.distribute(other * x), solution);
  EXPECT_LT(system.difference(solution, x), 1e-12);
}

TEST_P(EachLinearSolver, SingularMatrixIsNoticedAndItsDirectionFound) {
  // row 5 becomes zero, so nothing resists a direction that the left kernel e_5 allows
  system.change([](long long row, long long, double& value) {
    if (row == 5) value = 0.0;
  });
  const auto solver = make(GetParam(), system);
  Vector x(system.rows());
  const Vector b = system.distribute(Eigen::VectorXd::Ones(system.size()));
  EXPECT_TRUE(!solver->factor() || !solver->solve(b, x).is_sound());
  Vector direction(system.rows());
  EXPECT_LT(solver->weakest_direction(direction), 2e-15);
  EXPECT_NEAR(direction.largest(), 1.0, 1e-12);
}

// The large entries couple pairs of rows that stand far apart in any order, so most pivots are
// delayed. MUMPS needs more workspace for them than it foresees, and a second attempt.
TEST_P(EachLinearSolver, ZerosOnTheDiagonalAreNoObstacle) {
  const int half = 120;
  Eigen::MatrixXd dense = 1e-3 * band_with_far_entries(2 * half);
  dense.diagonal().setZero();
  for (int i = 0; i < half; ++i) {
    dense(i, (i + 61) % half + half) = 1.0;
    dense((i + 61) % half + half, i) = -2.0;
  }
  const ScatteredSystem hollow(dense);
  const auto solver = make(GetParam(), hollow);
  ASSERT_TRUE(solver->factor());
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(hollow.size(), -1.0, 2.0);
  Vector solution(hollow.rows());
  EXPECT_LT(solver->solve(hollow.distribute(dense * x), solution).size, 1e-13);
  EXPECT_LT(hollow.difference(solution, x), 1e-10);
}

TEST_P(EachLinearSolver, UnknownsMayDifferInSizeByOrders) {
  Eigen::MatrixXd dense = system.dense();
  for (int i = 0; i < system.size(); ++i) dense.col(i) *= std::pow(10.0, i % 9 - 4);
  const ScatteredSystem scaled(dense);
  const auto solver = make(GetParam(), scaled);
  ASSERT_TRUE(solver->factor());
  Vector solution(scaled.rows());
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(scaled.size(), 1.0, 2.0);
  EXPECT_LT(solver->solve(scaled.distribute(b), solution).size, 1e-13);
}

TEST_P(EachLinearSolver, FactorsAfterASingularMatrix) {
  const auto values = system.matrix()->values();
  const std::vector<double> sound(values.begin(), values.end());
  const auto solver = make(GetParam(), system);
  std::ranges::fill(values, 0.0);
  EXPECT_FALSE(solver->factor());
  std::ranges::copy(sound, values.begin());
  ASSERT_TRUE(solver->factor());
  Vector solution(system.rows());
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(system.size());
  EXPECT_LT(solver->solve(system.distribute(b), solution).size, 1e-14);
}

TEST_P(EachLinearSolver, FactorsOutliveTheSearchForTheWeakestDirection) {
  const auto solver = make(GetParam(), system);
  ASSERT_TRUE(solver->factor());
  Vector direction(system.rows());
  EXPECT_GT(solver->weakest_direction(direction), 1e-6);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(system.size(), -1.0, 2.0);
  Vector solution(system.rows());
  solver->solve(system.distribute(system.dense() * x), solution);
  EXPECT_LT(system.difference(solution, x), 1e-12);
}

TEST_P(EachLinearSolver, NumbersThatAreNotFiniteHaveNoDirection) {
  if (system.comm().rank() == system.comm().size() - 1) {
    system.matrix()->values()[1] = std::numeric_limits<double>::quiet_NaN();
  }
  const auto solver = make(GetParam(), system);
  Vector direction(system.rows());
  EXPECT_EQ(solver->weakest_direction(direction), 0.0);
  EXPECT_EQ(direction.largest(), 0.0);
}

TEST(SymmetryCheck, FindsOneEntryWithoutMirrorImageOnAnyNumberOfRanks) {
  Eigen::MatrixXd dense = band_with_far_entries();
  dense = (dense + dense.transpose()).eval();
  const ScatteredSystem system(dense);
  SymmetryCheck check(assembly::tpetra(std::as_const(*system.matrix())));
  const auto asymmetry = [&] { return system.comm().max(check.asymmetry()); };
  EXPECT_LT(asymmetry(), 1e-15);
  for (const double change : {1e-9, 1e-3}) {
    system.set_entry(31, 30, (1.0 + change) * dense(31, 30));
    EXPECT_GT(asymmetry(), 0.02 * change);
    EXPECT_LT(asymmetry(), 1.01 * change);
  }
  system.set_entry(31, 30, dense(31, 30));
  EXPECT_LT(asymmetry(), 1e-15);
}

// Several ranks of MUMPS sum up in an order that changes from one call to the next.
TEST(ChooseLinearSolver, SolutionsOfSmallMatricesAreTheSameEachTime) {
  const ScatteredSystem system(
      Eigen::MatrixXd::Ones(150, 150) +
      Eigen::MatrixXd(Eigen::VectorXd::LinSpaced(150, 1.0, 9.0).asDiagonal()));
  const auto solver = make("MUMPS", system);
  const Vector b = system.distribute(Eigen::VectorXd::LinSpaced(system.size(), -1.0, 2.0));
  Vector first(system.rows()), again(system.rows());
  ASSERT_TRUE(solver->factor());
  solver->solve(b, first);
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(solver->factor());
    solver->solve(b, again);
    EXPECT_TRUE(std::ranges::equal(first.values(), again.values()));
  }
}

TEST(ChooseLinearSolver, TakesMumpsForDenseFactorsOnly) {
  Eigen::MatrixXd chain = Eigen::MatrixXd::Identity(200, 200);
  for (int i = 1; i < 200; ++i) chain(i, i - 1) = chain(i - 1, i) = 0.25;
  const ScatteredSystem slender(chain);
  const ScatteredSystem dense(Eigen::MatrixXd::Ones(150, 150) +
                              Eigen::MatrixXd::Identity(150, 150));
  const auto choose = [](const ScatteredSystem& system) {
    return choose_linear_solver("Automatic", system.matrix(), system.comm());
  };
  EXPECT_EQ(choose(slender).solver->name(), "Block LU");
  EXPECT_EQ(choose(slender).reason.find("Block LU, automatic: fronts of "), 0u);
  EXPECT_EQ(choose(dense).solver->name(), "MUMPS");
  EXPECT_EQ(choose(dense).reason.find("MUMPS, automatic: fronts of "), 0u);
}

TEST(ChooseLinearSolver, TakesKlu2ForOneFactorisation) {
  const ScatteredSystem system;
  for (const char* name : {"Automatic", "Block LU"}) {
    const auto chosen = choose_for_one_factorisation(name, system.matrix(), system.comm());
    EXPECT_EQ(chosen.solver->name(), "KLU2") << name;
  }
}

TEST(RootedKlu2, KeptPivotsThatDoNotServeAreReplaced) {
  ScatteredSystem system;
  const auto solver = make_rooted_klu2(system.matrix(), system.comm());
  ASSERT_TRUE(solver->factor());
  const std::vector<int> before = solver->pivots();
  // what was largest becomes nothing beside the others
  system.scale_diagonal(1e-14);
  ASSERT_TRUE(solver->factor());
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(system.size(), -1.0, 2.0);
  Vector solution(system.rows());
  EXPECT_LT(solver->solve(system.distribute(system.dense() * x), solution).size, 1e-12);
  EXPECT_LT(system.difference(solution, x), 1e-10);
  EXPECT_EQ(solver->pivots() != before, system.comm().is_root());
}

TEST(RootedKlu2, GoesOnBitByBitWithThePivotsOfAnother) {
  ScatteredSystem system;
  system.scale_diagonal(1e-4);  // too small for pivots, now
  const auto solver = make_rooted_klu2(system.matrix(), system.comm());
  ASSERT_TRUE(solver->factor());
  system.scale_diagonal(1e3);
  const auto resumed = make_rooted_klu2(system.matrix(), system.comm());
  const auto fresh = make_rooted_klu2(system.matrix(), system.comm());
  ASSERT_TRUE(resumed->set_pivots(solver->pivots()));
  const Vector b = system.distribute(Eigen::VectorXd::LinSpaced(system.size(), 1.0, 2.0));
  Vector x(system.rows()), y(system.rows()), z(system.rows());
  ASSERT_TRUE(solver->factor() && resumed->factor() && fresh->factor());
  EXPECT_LT(solver->solve(b, x).size, 1e-12);
  resumed->solve(b, y);
  fresh->solve(b, z);
  EXPECT_TRUE(std::ranges::equal(x.values(), y.values()));
  EXPECT_FALSE(std::ranges::equal(x.values(), z.values()));
  EXPECT_EQ(solver->pivots(), resumed->pivots());
  EXPECT_EQ(solver->pivots() != fresh->pivots(), system.comm().is_root());
}

TEST(RootedKlu2, TakesPivotsOfDenseBlocks) {
  const int size = 24;
  Eigen::MatrixXd dense(size, size);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) dense(i, j) = std::sin(1.0 + 5.0 * i * i + 3.0 * j * j * i);
  }
  const ScatteredSystem system(dense);
  const auto solver = make_rooted_klu2(system.matrix(), system.comm());
  const auto resumed = make_rooted_klu2(system.matrix(), system.comm());
  ASSERT_TRUE(solver->factor());
  EXPECT_TRUE(resumed->set_pivots(solver->pivots()));
  EXPECT_EQ(solver->pivots(), resumed->pivots());
}

TEST(RootedKlu2, PivotsOfAnotherSizeAreRefused) {
  const ScatteredSystem system;
  const auto solver = make_rooted_klu2(system.matrix(), system.comm());
  EXPECT_FALSE(solver->set_pivots(std::vector<int>{1, 0}));
  EXPECT_FALSE(solver->set_pivots(std::vector<int>(system.size(), 0)));
}

}  // namespace
}  // namespace culm::solver
