/// Factors of one dense matrix, by LAPACK.
#pragma once

#include <culm/solver/linear_solver.hpp>

#include "symmetry.hpp"

#include <span>
#include <vector>

namespace culm::solver {

/// LU with pivots from columns, or L D L^T of a symmetric matrix, with blocks of one or two pivots.
/// @source J. R. Bunch, L. Kaufman, Some stable methods for calculating inertia and solving
/// symmetric linear systems, 1977
class DenseFactors {
 public:
  /// Where the next matrix goes, row by row; zeros. @param size  rows and columns
  std::span<double> start(int size);
  /// Factors what was put there. @return false if a pivot is zero
  bool factor(Symmetry symmetry);
  /// Replaces b by A^-1 b.
  void solve(std::span<double> b) const;
  /// Of the matrix that was factored last.
  Determinant determinant() const;

 private:
  std::size_t column(int j) const;

  int n_ = 0;
  Symmetry symmetry_ = Symmetry::none;
  std::vector<double> factors_;  ///< of the transposed matrix, as LAPACK goes column by column
  std::vector<int> pivots_;
  std::vector<double> room_;
};

}  // namespace culm::solver
