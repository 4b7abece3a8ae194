/// The operator that all eigensolvers share: (A - shift B)^-1 on whole vectors.
#pragma once

#include <culm/solver/eigen_solver.hpp>
#include <culm/solver/linear_solver.hpp>

#include "whole_vector.hpp"

namespace culm::solver {

/// Products with the matrices of a pencil, and the solution with one factored combination of them.
/// Vectors are whole on every rank, so serial algorithms run alike on all of them. All functions
/// are collective.
class ShiftInvert {
 public:
  using Column = Eigen::Ref<Eigen::VectorXd>;
  using ConstColumn = Eigen::Ref<const Eigen::VectorXd>;

  /// Factors A - shift B. Throws NumericalError if it is singular.
  ShiftInvert(const SymmetricPencil& pencil, const EigenSettings& settings,
              const parallel::Comm& comm);

  int size() const { return whole_.size(); }
  double shift() const { return shift_; }
  void multiply_A(const ConstColumn& x, Column y) const { multiply(*pencil_.A, x, y); }
  void multiply_B(const ConstColumn& x, Column y) const { multiply(*pencil_.B, x, y); }
  /// y = (A - shift B)^-1 x. Throws NumericalError if the factors are useless.
  void solve(const ConstColumn& x, Column y);
  /// |x|^T |A| |x|.
  double size_of_A(const ConstColumn& x) const;
  /// A matrix whole on every rank.
  Eigen::MatrixXd dense(const assembly::CrsMatrix& matrix) const;
  const SymmetricPencil& pencil() const { return pencil_; }

 private:
  void multiply(const assembly::CrsMatrix& matrix, const ConstColumn& x, Column y) const;

  SymmetricPencil pencil_;
  parallel::Comm comm_;
  double shift_;
  WholeVector whole_;
  Teuchos::RCP<assembly::CrsMatrix> shifted_;
  std::unique_ptr<LinearSolver> linear_;
  mutable Vector in_;
  mutable Vector out_;
};

}  // namespace culm::solver
