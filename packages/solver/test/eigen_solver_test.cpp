#include <culm/base/error.hpp>
#include <culm/solver/asymmetry.hpp>
#include <culm/solver/eigen_solver.hpp>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace culm::solver {
namespace {

using assembly::Matrix;

// Chains of unit masses and springs side by side, all alike, so that every value is multiple. One
// end is held: by nothing, or by a constraint with a multiplier, which is the last unknown of a
// chain.
struct Chains {
  int count = 1;
  int length = 8;
  bool held = true;

  int chain_size() const { return length + (held ? 1 : 0); }
  int size() const { return count * chain_size(); }

  Eigen::MatrixXd stiffness() const {
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size(), size());
    for (int first = 0; first < size(); first += chain_size()) {
      for (int i = first; i + 1 < first + length; ++i) {
        K.block<2, 2>(i, i) += (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
      }
      if (held) K(first, first + length) = K(first + length, first) = 1.0;
    }
    return K;
  }
  Eigen::MatrixXd mass() const {
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(size(), size());
    for (int i = 0; i < size(); ++i) M(i, i) = i % chain_size() < length ? 1.0 : 0.0;
    return M;
  }
  // omega^2 of one chain with a held or with two free ends
  double value(int mode) const {
    const double angle = held ? (2.0 * mode + 1.0) * std::numbers::pi / (2.0 * (2.0 * length - 1.0))
                              : mode * std::numbers::pi / (2.0 * length);
    return 4.0 * std::pow(std::sin(angle), 2);
  }
};

class Pencil {
 public:
  explicit Pencil(const Chains& chains) : chains_(chains) {
    std::vector<long long> mine;
    for (int i = comm_.rank(); i < chains.size(); i += comm_.size()) mine.push_back(i);
    const assembly::Rows rows(mine, comm_);
    pencil_ = {fill(rows, chains.stiffness()), fill(rows, chains.mass())};
  }

  EigenPairs solve(EigenSettings settings) const {
    return solve_eigenproblem(pencil_, settings, comm_);
  }
  const SymmetricPencil& matrices() const { return pencil_; }
  const parallel::Comm& comm() const { return comm_; }

  void expect_right(const EigenPairs& pairs, int count) const {
    const Eigen::MatrixXd K = chains_.stiffness();
    const Eigen::MatrixXd M = chains_.mass();
    ASSERT_EQ(static_cast<int>(pairs.values.size()), count);
    for (int i = 0; i < count; ++i) {
      EXPECT_NEAR(pairs.values[static_cast<std::size_t>(i)], chains_.value(i / chains_.count),
                  1e-12);
      const Eigen::VectorXd x = pairs.vectors.col(i);
      EXPECT_LT((K * x - pairs.values[static_cast<std::size_t>(i)] * M * x).norm(), 1e-10);
    }
    const Eigen::MatrixXd unit = pairs.vectors.transpose() * M * pairs.vectors;
    EXPECT_LT((unit - Eigen::MatrixXd::Identity(count, count)).norm(), 1e-10);
  }

 private:
  // all entries that either matrix has, so that both have one graph
  std::shared_ptr<const Matrix> fill(const assembly::Rows& rows,
                                     const Eigen::MatrixXd& dense) const {
    const Eigen::MatrixXd K = chains_.stiffness();
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < chains_.size(); ++i) {
      for (int j = 0; j < chains_.size(); ++j) {
        if (K(i, j) != 0.0 || i == j) entries.emplace_back(i, j, dense(i, j));
      }
    }
    Eigen::SparseMatrix<double> whole(chains_.size(), chains_.size());
    whole.setFromTriplets(entries.begin(), entries.end());
    return std::make_shared<const Matrix>(rows, whole);
  }

  Chains chains_;
  parallel::Comm comm_;
  SymmetricPencil pencil_;
};

std::shared_ptr<Matrix> scaled(const Matrix& matrix, double factor) {
  const auto copy = std::make_shared<Matrix>(matrix);
  for (double& value : copy->values()) value *= factor;
  return copy;
}

// Global row and column of each entry of this rank.
std::vector<std::pair<long long, long long>> places_of(const Matrix& matrix) {
  std::vector<std::pair<long long, long long>> places;
  matrix.each_entry([&](std::size_t row, long long column, double) {
    places.emplace_back(matrix.rows().global(row), column);
  });
  return places;
}

class EachEigenSolver : public testing::TestWithParam<std::string> {
 protected:
  EigenSettings settings(int count, double shift) const {
    return {GetParam(), "KLU2", count, shift};
  }
};
INSTANTIATE_TEST_SUITE_P(EigenSolver, EachEigenSolver,
                         testing::ValuesIn(std::next(eigen_solver_names().begin()),
                                           eigen_solver_names().end()),
                         [](const auto& test) { return test.param; });

TEST_P(EachEigenSolver, FindsTheLowestValuesBesideConstraints) {
  const Pencil pencil({1, 40, true});
  pencil.expect_right(pencil.solve(settings(6, -1e-3)), 6);
}

TEST_P(EachEigenSolver, FindsAllCopiesOfMultipleValues) {
  const Pencil pencil({3, 30, true});
  pencil.expect_right(pencil.solve(settings(9, -1e-3)), 9);
}

TEST_P(EachEigenSolver, FindsRigidMotionsAtZero) {
  const Pencil pencil({2, 30, false});
  const EigenPairs pairs = pencil.solve(settings(6, -1e-3));
  pencil.expect_right(pairs, 6);
  for (int i = 0; i < 2; ++i) {
    EXPECT_LT(std::abs(pairs.values[static_cast<std::size_t>(i)]),
              4.0 * pairs.rounding[static_cast<std::size_t>(i)]);
  }
  EXPECT_GT(pairs.values[2], 1e6 * pairs.rounding[2]);
}

// The nearer the shift is to values, the more of their vectors rounding mixes into the others.
TEST_P(EachEigenSolver, FindsElasticModesBesideRigidMotionsAtTheShift) {
  for (double shift : {-1e-9, -1e-11, -1e-12}) {
    const Pencil pencil({2, 30, false});
    pencil.expect_right(pencil.solve(settings(6, shift)), 6);
  }
}

TEST_P(EachEigenSolver, FindsTheValuesNextToAShift) {
  const Chains chains{1, 40, true};
  const Pencil pencil(chains);
  const double shift = 0.7 * chains.value(20) + 0.3 * chains.value(21);
  const EigenPairs pairs = pencil.solve(settings(3, shift));
  ASSERT_EQ(pairs.values.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(pairs.values[static_cast<std::size_t>(i)], chains.value(19 + i), 1e-11);
  }
}

// Values of structures of micrometres are 1e16 and more, and factors on a small load are large,
// too.
TEST_P(EachEigenSolver, IsAsExactWhateverTheSizeOfValues) {
  const Chains chains{2, 150, true};
  const Pencil pencil(chains);
  for (double factor : {1e12, 1e18, 1e-18}) {
    const auto K = scaled(*pencil.matrices().A, factor);
    const auto M = pencil.matrices().B;
    const EigenPairs pairs = solve_eigenproblem({K, M}, settings(8, -1e-6 * factor), pencil.comm());
    const auto D = scaled(*M, -1.0);
    const EigenPairs factors = solve_buckling({K, D, true}, settings(8, 0.0), pencil.comm());
    ASSERT_EQ(pairs.values.size(), 8U);
    ASSERT_EQ(factors.values.size(), 8U);
    for (int i = 0; i < 8; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double wanted = chains.value(i / 2);
      EXPECT_NEAR(pairs.values[at] / factor / wanted, 1.0, 1e-9) << GetParam() << ", " << factor;
      EXPECT_NEAR(factors.values[at] / factor / wanted, 1.0, 1e-9) << GetParam() << ", " << factor;
    }
    EXPECT_LT(pairs.worst_residual, 1e-11);
    EXPECT_LT(factors.worst_residual, 1e-11);
  }
}

// Three copies of each value, so that vectors are any basis of their spaces.
TEST_P(EachEigenSolver, GivesTheSameVectorsAsAnyOther) {
  const Pencil pencil({3, 30, true});
  const EigenPairs pairs = pencil.solve(settings(9, -1e-3));
  const EigenPairs dense = pencil.solve({"Dense", "KLU2", 9, -1e-3});
  ASSERT_EQ(pairs.vectors.cols(), 9);
  for (int i = 0; i < 9; ++i) {
    const Eigen::VectorXd x = pairs.vectors.col(i);
    const Eigen::VectorXd y = dense.vectors.col(i);
    EXPECT_LT((x - std::copysign(1.0, x.dot(y)) * y).norm(), 1e-9);
  }
  // the first copy moves in the first chain, where unknowns come first, the next in the second
  const Eigen::VectorXd second = pairs.vectors.col(1).segment(31, 30);
  EXPECT_NEAR(second.norm(), 1.0, 1e-9);
}

TEST(EigenSolver, TakesTheMethodThatFitsSizeAndRanks) {
  const Pencil small({1, 40, true});
  EXPECT_EQ(small.solve({"Automatic", "KLU2", 4, -1e-3}).solver, "Dense");
  const Pencil large({2, 150, true});
  const EigenPairs pairs = large.solve({"Automatic", "KLU2", 4, -1e-5});
  EXPECT_EQ(pairs.solver, "Spectra");
  large.expect_right(pairs, 4);
  const EigenPairs distributed = large.solve({"Anasazi", "KLU2", 4, -1e-5});
  EXPECT_EQ(distributed.solver, "Anasazi");
  large.expect_right(distributed, 4);
}

TEST(EigenSolver, GivesAsManyAsThereAre) {
  const Pencil pencil({1, 4, true});
  EXPECT_EQ(pencil.solve({"Automatic", "KLU2", 10, -1e-3}).values.size(), 3U);
}

TEST(EigenSolver, FindsMotionsThatNothingResists) {
  const Pencil pencil({5, 1, false});
  const EigenPairs pairs = pencil.solve({"Dense", "KLU2", 5, -1e-3});
  pencil.expect_right(pairs, 5);
  EXPECT_LT(pairs.worst_residual, 1e-12);
}

TEST(EigenSolver, RefusesAShiftThatIsAnEigenvalue) {
  const Pencil pencil({1, 40, false});
  EXPECT_THROW(pencil.solve({"Spectra", "KLU2", 3, 0.0}), NumericalError);
}

TEST_P(EachEigenSolver, FindsBucklingFactorsOfBothSignsWithCopies) {
  // K + mu D is singular at mu = -omega^2 of K x = omega^2 M x, so D = -M gives factors omega^2
  const Chains chains{2, 30, true};
  const Pencil pencil(chains);
  const auto D = scaled(*pencil.matrices().B, -1.0);
  const EigenPairs pairs =
      solve_buckling({pencil.matrices().A, D, true}, settings(6, 0.0), pencil.comm());
  ASSERT_EQ(pairs.values.size(), 6U);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(pairs.values[static_cast<std::size_t>(i)], chains.value(i / 2), 1e-11);
  }
  EXPECT_LT(pairs.worst_residual, 1e-12);
  const EigenPairs reversed = solve_buckling({pencil.matrices().A, pencil.matrices().B, true},
                                             settings(2, 0.0), pencil.comm());
  EXPECT_NEAR(reversed.values.front(), -chains.value(0), 1e-11);
}

// K and D = -M exchanged: factors 1 / omega^2, the smallest of the highest frequencies, which lie
// within 1e-5 of each other. A small Krylov space does not tell them apart in any number of
// restarts.
TEST(EigenSolver, WidensTheSpaceForFactorsThatLieTogether) {
  const Chains chains{1, 300, true};
  const Pencil pencil(chains);
  const auto K = scaled(*pencil.matrices().B, 1.0);
  const auto D = scaled(*pencil.matrices().A, -1.0);
  const auto places = places_of(*K);
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (places[k].first != 300 && places[k].second != 300) continue;
    K->values()[k] = -D->values()[k];  // the constraint
    D->values()[k] = 0.0;
  }
  const EigenPairs pairs = solve_buckling({K, D, true}, {"Spectra", "KLU2", 3, 0.0}, pencil.comm());
  ASSERT_EQ(pairs.values.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(pairs.values[static_cast<std::size_t>(i)], 1.0 / chains.value(298 - i), 1e-10);
  }
  EXPECT_NE(pairs.note.find("Krylov space of"), std::string::npos) << pairs.note;
}

TEST(EigenSolver, ReducesWholeMatricesWhereAKrylovSpaceIsTooSmall) {
  const Pencil pencil({1, 40, true});
  const EigenPairs pairs = pencil.solve({"Spectra", "KLU2", 30, -1e-3});
  pencil.expect_right(pairs, 30);
  EXPECT_EQ(pairs.solver, "Dense");
  EXPECT_FALSE(pairs.note.empty());
  const EigenPairs all = pencil.solve({"Spectra", "KLU2", 60, -1e-3});
  EXPECT_EQ(all.values.size(), 39U);
  EXPECT_TRUE(all.are_all);
}

TEST_P(EachEigenSolver, FindsDampedAndGyroscopicValues) {
  // C = a M + b K: lambda^2 + (a + b omega^2) lambda + omega^2 = 0
  const Chains chains{1, 40, true};
  const Pencil pencil(chains);
  const double a = 0.01, b = 0.3;
  const auto C = scaled(*pencil.matrices().B, a);
  const auto places = places_of(*C);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const bool border = places[k].first == 40 || places[k].second == 40;
    if (!border) C->values()[k] += b * pencil.matrices().A->values()[k];
  }
  const ComplexPairs pairs = solve_quadratic({pencil.matrices().A, C, pencil.matrices().B},
                                             settings(4, 1e-3), pencil.comm());
  ASSERT_EQ(pairs.values.size(), 4U);
  for (int i = 0; i < 4; ++i) {
    const double square = chains.value(i);
    const double half = 0.5 * (a + b * square);
    const std::complex<double> wanted(-half, std::sqrt(square - half * half));
    EXPECT_LT(std::abs(pairs.values[static_cast<std::size_t>(i)] - wanted), 1e-10);
  }
  EXPECT_LT(pairs.worst_residual, 1e-12);
}

// Free chains move as a whole, which is a double value at zero: it is told once, and hides nothing.
TEST_P(EachEigenSolver, FindsFreeMotionsOnceBesideDampedOnes) {
  for (const Chains& chains : {Chains{2, 5, false}, Chains{3, 60, false}}) {
    const Pencil pencil(chains);
    const double b = 0.01;
    const auto C = scaled(*pencil.matrices().A, b);
    const int count = 3 * chains.count;
    const ComplexPairs pairs = solve_quadratic({pencil.matrices().A, C, pencil.matrices().B},
                                               settings(count, 1e-5), pencil.comm());
    ASSERT_EQ(static_cast<int>(pairs.values.size()), count);
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double square = chains.value(i / chains.count);
      const bool is_free = i < chains.count;
      EXPECT_EQ(is_zero(pairs.values[at], pairs.rounding[at]), is_free) << pairs.values[at];
      if (is_free) continue;
      const double half = 0.5 * b * square;
      const std::complex<double> wanted(-half, std::sqrt(square - half * half));
      EXPECT_LT(std::abs(pairs.values[at] - wanted), 1e-9);
    }
    EXPECT_LT(pairs.worst_residual, 1e-9);
    // motions of all chains, each by itself or mixed
    const Eigen::MatrixXcd free = pairs.vectors.leftCols(chains.count);
    const Eigen::MatrixXcd unit = free.adjoint() * chains.mass() * free;
    EXPECT_LT((unit - Eigen::MatrixXcd::Identity(chains.count, chains.count)).norm(), 1e-8);
    EXPECT_LT((chains.stiffness() * free).norm(), 1e-8);
  }
}

TEST_P(EachEigenSolver, IsAsExactWithDampingWhateverTheUnitOfTime) {
  for (const bool held : {true, false}) {
    const Chains chains{2, 80, held};
    const Pencil pencil(chains);
    const double b = 0.01;
    for (double unit : {1.0, 1e-4, 1e5, 1e9}) {
      const auto K = scaled(*pencil.matrices().A, unit * unit);
      const auto C = scaled(*pencil.matrices().B, b * unit);
      const auto M = pencil.matrices().B;
      const ComplexPairs pairs =
          solve_quadratic({K, C, M}, settings(8, 1e-5 * unit), pencil.comm());
      ASSERT_EQ(pairs.values.size(), 8U);
      for (int i = 0; i < 8; ++i) {
        const double square = chains.value(i / 2);
        if (square < 1e-12) continue;  // in each copy 0 and -b
        const std::complex<double> root = std::sqrt(std::complex<double>(0.25 * b * b - square));
        const std::complex<double> wanted = -0.5 * b + root;
        const bool is_there = std::ranges::any_of(pairs.values, [&](std::complex<double> value) {
          return std::abs(value / unit - wanted) < 1e-9;
        });
        EXPECT_TRUE(is_there || i / 2 > 1) << GetParam() << held << unit << wanted;
      }
      EXPECT_LT(pairs.worst_residual, 1e-9);
    }
  }
}

// Rounding makes finite values of the infinite ones of constraints; they are no solutions.
TEST(EigenSolver, GivesAsManyComplexPairsAsThereAre) {
  const Chains chains{1, 8, true};
  const Pencil pencil(chains);
  const auto C = scaled(*pencil.matrices().B, 0.01);
  const ComplexPairs pairs = solve_quadratic({pencil.matrices().A, C, pencil.matrices().B},
                                             {"Dense", "KLU2", 20, 1e-3}, pencil.comm());
  ASSERT_EQ(pairs.values.size(), 7U);
  for (int i = 0; i < 7; ++i) {
    EXPECT_NEAR(std::norm(pairs.values[static_cast<std::size_t>(i)]), chains.value(i), 1e-10);
  }
}

TEST(EigenSolver, MeasuresAsymmetry) {
  const Pencil pencil({1, 10, true});
  EXPECT_EQ(asymmetry(pencil.matrices().A, pencil.comm()), 0.0);
  const auto skew = scaled(*pencil.matrices().A, 1.0);
  const auto places = places_of(*skew);
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (places[k] == std::pair(3LL, 4LL)) skew->values()[k] += 1e-4;
  }
  EXPECT_NEAR(asymmetry(skew, pencil.comm()), 0.5e-4, 1e-8);  // the largest entry of a row is 2
}

}  // namespace
}  // namespace culm::solver
