/// The operator that all eigensolvers share: the inverse of a matrix, on whole vectors.
#pragma once

#include <culm/solver/eigen_solver.hpp>
#include <culm/solver/linear_solver.hpp>

#include "whole_vector.hpp"

#include <utility>

namespace culm::solver {

/// sum_k factor_k matrix_k of matrices of one graph.
std::shared_ptr<assembly::Matrix> combine(
    const std::vector<std::pair<double, std::shared_ptr<const assembly::Matrix>>>& terms);

/// Products with matrices of one graph, and solutions with one that is factored. Vectors are whole
/// on every rank, so serial algorithms run alike on all of them. All functions are collective.
class ShiftInvert {
 public:
  using Column = Eigen::Ref<Eigen::VectorXd>;
  using ConstColumn = Eigen::Ref<const Eigen::VectorXd>;

  /// Throws NumericalError if the matrix is singular.
  ShiftInvert(const std::shared_ptr<assembly::Matrix>& factored, const std::string& linear_solver,
              const parallel::Comm& comm);

  int size() const { return whole_.size(); }
  const WholeVector& whole() const { return whole_; }
  /// y = A^-1 x. Throws NumericalError if the factors are useless.
  void solve(const Vector& x, Vector& y);
  void solve(const ConstColumn& x, Column y);
  void multiply(const assembly::Matrix& matrix, const ConstColumn& x, Column y) const;
  /// |A| |x|: what a product is made of, and rounding grows with.
  Eigen::VectorXd absolute(const assembly::Matrix& matrix, const Eigen::VectorXd& x) const;
  /// x^T A x, the sums of rows in extended precision: for eigenvectors these are small differences
  /// of large terms, and in double precision the order of terms would show.
  double quotient(const assembly::Matrix& matrix, const Eigen::VectorXd& x) const;
  /// A matrix whole on every rank.
  Eigen::MatrixXd dense(const assembly::Matrix& matrix) const;

 private:
  parallel::Comm comm_;
  WholeVector whole_;
  std::shared_ptr<assembly::Matrix> factored_;
  std::unique_ptr<LinearSolver> linear_;
  mutable Vector in_;
  mutable Vector out_;
};

}  // namespace culm::solver
