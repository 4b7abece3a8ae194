/// The methods behind solve_eigenproblem. Each finds eigenvalues nu of (A - shift B)^-1 B, hence
/// lambda = shift + 1 / nu, largest |nu| first.
#pragma once

#include "shift_invert.hpp"

namespace culm::solver {

/// Some nu with vectors, columns with x^T B x = 1.
struct InvertedPairs {
  Eigen::VectorXd nu;
  Eigen::MatrixXd vectors;
};

/// All of them, but for those that are zero. (A - shift B)^-1 between the range of B is a symmetric
/// matrix, whatever border A has.
InvertedPairs solve_dense(ShiftInvert& op);

/// The first `count` in the B-orthogonal complement of the columns of `found`: implicitly restarted
/// Lanczos of Spectra, alike on all ranks.
InvertedPairs solve_spectra(ShiftInvert& op, int count, const Eigen::MatrixXd& found);

}  // namespace culm::solver
