#include "../src/dense_factors.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

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

bool factor(DenseFactors& factors, const Eigen::MatrixXd& A, Symmetry symmetry) {
  const std::span<double> room = factors.start(static_cast<int>(A.rows()));
  const Eigen::MatrixXd by_rows = A.transpose();
  std::copy_n(by_rows.data(), by_rows.size(), room.data());
  return factors.factor(symmetry);
}

TEST(DenseFactors, SolveAndKnowTheDeterminant) {
  for (const int size : {1, 2, 5, 80}) {
    for (const Symmetry symmetry : {Symmetry::symmetric, Symmetry::none}) {
      Eigen::MatrixXd A = indefinite(size) + Eigen::MatrixXd::Identity(size, size);
      if (symmetry == Symmetry::none) A(0, size - 1) += 2.0;
      DenseFactors factors;
      ASSERT_TRUE(factor(factors, A, symmetry));
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
    EXPECT_FALSE(factor(factors, A, symmetry));
    EXPECT_TRUE(factor(factors, indefinite(6), symmetry));
  }
}

}  // namespace
}  // namespace culm::solver
