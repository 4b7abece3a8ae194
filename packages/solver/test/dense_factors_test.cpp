#include "../src/dense_factors.hpp"

#include "../src/serial_matrix.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace culm::solver {
namespace {

// Such that Bunch and Kaufman need pivots of both kinds.
Eigen::MatrixXd indefinite(int size) {
  Eigen::MatrixXd any(size, size);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) any(i, j) = std::sin(1.0 + 3.0 * i + 7.0 * j);
  }
  Eigen::MatrixXd A = any + any.transpose();
  A.diagonal().head(size / 2).setZero();
  return A;
}

Teuchos::RCP<assembly::CrsMatrix> stored(const Eigen::MatrixXd& dense) {
  const auto size = static_cast<std::size_t>(dense.rows());
  std::vector<std::size_t> begin{0};
  std::vector<int> columns;
  for (std::size_t row = 0; row < size; ++row) {
    for (std::size_t column = 0; column < size; ++column)
      columns.push_back(static_cast<int>(column));
    begin.push_back(columns.size());
  }
  auto matrix = make_serial_matrix(begin, columns);
  const auto values = matrix->getLocalMatrixHost().values;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    values(k) = dense(static_cast<int>(k / size), columns[k]);
  }
  return matrix;
}

TEST(DenseFactors, SolveAndKnowTheDeterminant) {
  for (const int size : {1, 2, 5, 80}) {
    for (const Symmetry symmetry : {Symmetry::symmetric, Symmetry::none}) {
      Eigen::MatrixXd A = indefinite(size) + Eigen::MatrixXd::Identity(size, size);
      if (symmetry == Symmetry::none) A(0, size - 1) += 2.0;
      DenseFactors factors;
      ASSERT_TRUE(factors.factor(*stored(A), symmetry));
      const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(size, -1.0, 2.0);
      Eigen::VectorXd found = A * x;
      factors.solve({found.data(), static_cast<std::size_t>(size)});
      const Eigen::FullPivLU<Eigen::MatrixXd> exact(A);
      EXPECT_LT((found - x).lpNorm<Eigen::Infinity>(), 1e-13 / exact.rcond()) << size;
      const Determinant determinant = factors.determinant();
      EXPECT_EQ(determinant.sign, exact.determinant() > 0.0 ? 1 : -1) << size;
      EXPECT_NEAR(determinant.log_size, std::log(std::abs(exact.determinant())), 1e-9) << size;
      if (symmetry == Symmetry::symmetric) {
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(A);
        EXPECT_EQ(determinant.negative, (eigen.eigenvalues().array() < 0.0).count()) << size;
      } else {
        EXPECT_FALSE(determinant.negative);
      }
    }
  }
}

TEST(DenseFactors, ZeroPivotsAreNoticed) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(6, 6);
  A(3, 3) = 0.0;
  for (const Symmetry symmetry : {Symmetry::symmetric, Symmetry::none}) {
    DenseFactors factors;
    EXPECT_FALSE(factors.factor(*stored(A), symmetry));
    EXPECT_TRUE(factors.factor(*stored(indefinite(6)), symmetry));
  }
}

}  // namespace
}  // namespace culm::solver
