#include <culm/analysis/relaxing_modes.hpp>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace culm::analysis {
namespace {

using Complex = std::complex<double>;

SparseMatrix sparse(const Eigen::MatrixXd& dense) { return dense.sparseView(); }

BranchTerm term(const Eigen::MatrixXd& matrix, double time, Complex shift = 0.0) {
  return {sparse(matrix).cast<Complex>(), time, shift};
}

// What is left of T(lambda) x, written out term by term.
double residual(const RelaxingPencil& pencil, const ComplexMode& mode) {
  const Complex s = mode.value;
  Eigen::VectorXcd r = pencil.K * mode.vector;
  r += s * s * (pencil.M * mode.vector).eval();
  r += s * (pencil.C * mode.vector).eval();
  for (const BranchTerm& one : pencil.terms) {
    const Complex rate = (s + one.shift) * one.time;
    r += rate / (1.0 + rate) * (one.matrix * mode.vector).eval();
  }
  return r.norm() / (pencil.K * mode.vector).norm();
}

// (1 + s T) (s^2 + 9) + 9 g s T = 0: of one unknown all is known but the root.
TEST(RelaxingModes, OfOneUnknownAreRootsOfTheCubic) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  for (const double g : {1e-3, 0.5, 4.0}) {
    for (const double T : {0.01, 0.3, 20.0}) {
      const RelaxingPencil pencil{
          sparse(9.0 * one), sparse(0.0 * one), sparse(one), {term(9.0 * g * one, T)}};
      const ComplexMode mode =
          compute_relaxing_mode(pencil, {Complex(0.0, 3.0), Eigen::VectorXcd::Ones(1)});
      const Complex s = mode.value;
      const Complex cubic = (1.0 + s * T) * (s * s + 9.0) + 9.0 * g * s * T;
      EXPECT_LT(std::abs(cubic), 1e-12 * (1.0 + std::abs(s) * T) * std::norm(s));
      EXPECT_GT(s.imag(), 3.0) << "the branch stiffens";
      EXPECT_LT(s.real(), 0.0) << "and damps";
    }
  }
}

// (1 + s T) (s^2 + 2 s + 9) - s T s = 0: a damper that ceases to act where it follows with delay.
TEST(RelaxingModes, DelayedVelocitiesHaveARootOfTheCubicToo) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  for (const double T : {0.01, 0.3, 20.0}) {
    BranchTerm delayed = term(-one, T);
    delayed.of_velocity = true;
    const RelaxingPencil pencil{sparse(9.0 * one), sparse(2.0 * one), sparse(one), {delayed}};
    const ComplexMode mode =
        compute_relaxing_mode(pencil, {Complex(-1.0, 3.0), Eigen::VectorXcd::Ones(1)});
    const Complex s = mode.value;
    const Complex cubic = (1.0 + s * T) * (s * s + 2.0 * s + 9.0) - s * T * s;
    EXPECT_LT(std::abs(cubic), 1e-12 * (1.0 + std::abs(s) * T) * std::norm(s));
    EXPECT_LT(s.real(), -0.49);
    EXPECT_GT(s.real(), -1.1);
  }
}

// Branches of some springs only, with damping that is not symmetric: shapes change.
TEST(RelaxingModes, SolveTheEquationsWhereShapesChange) {
  Eigen::MatrixXd K(3, 3), C(3, 3), M(3, 3), first(3, 3), second(3, 3);
  K << 5, -2, 0, -2, 6, -3, 0, -3, 4;
  C << 0.1, 0.4, 0, -0.4, 0.05, 0.1, 0, 0, 0.2;
  M << 1, 0, 0, 0, 2, 0, 0, 0, 1.5;
  first << 2, -2, 0, -2, 2, 0, 0, 0, 0;
  second << 0, 0, 0, 0, 0, 0, 0, 0, 1;
  const RelaxingPencil pencil{
      sparse(K), sparse(C), sparse(M), {term(first, 0.4), term(second, 3.0, Complex(0.0, 0.2))}};
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> lasting(K, M);
  std::vector<Complex> found;
  for (int i = 0; i < 3; ++i) {
    const ComplexMode start{Complex(0.0, std::sqrt(lasting.eigenvalues()[i])),
                            lasting.eigenvectors().col(i).cast<Complex>()};
    const ComplexMode mode = compute_relaxing_mode(pencil, start);
    EXPECT_LT(residual(pencil, mode), 1e-12);
    EXPECT_LT(mode.residual, 1e-12);
    for (const Complex& other : found) EXPECT_GT(std::abs(other - mode.value), 0.1);
    found.push_back(mode.value);
  }
}

}  // namespace
}  // namespace culm::analysis
