/// Vibrations with viscoelastic branches, whose internal states are condensed.
#pragma once

#include <culm/analysis/multi_blade.hpp>

#include <Eigen/SparseCore>

#include <complex>
#include <vector>

namespace culm::analysis {

/// Branches of one relaxation time, as a function of the eigenvalue: f(s) A, or f(s) s A, with
/// s = lambda + shift and f(s) = s time / (1 + s time), what a spring of the branch follows of a
/// motion exp(s t).
struct BranchTerm {
  Eigen::SparseMatrix<std::complex<double>> matrix;  ///< A, if the springs follow at once
  double time = 0.0;                                 ///< [s]
  std::complex<double> shift = 0.0;  ///< i m Omega of patterns that turn against the observer
  bool of_velocity = false;          ///< whether what acts on the branch is a velocity
};

/// T(lambda) x = (lambda^2 M + lambda C + K + sum of terms) x = 0: the states of branches are
/// condensed, so there are as many unknowns as without them, and none of the decaying motions that
/// branches have of their own.
struct RelaxingPencil {
  SparseMatrix K, C, M;
  std::vector<BranchTerm> terms;
};

/// A motion x exp(lambda t).
struct ComplexMode {
  std::complex<double> value;
  Eigen::VectorXcd vector;
  double residual = 0.0;  ///< largest |T x| over the largest | |K| |x| |
};

/// The eigenpair of a pencil that a motion without branches becomes, of a pair of conjugates that
/// with the positive frequency: Newton's method for the pair, from the value that the pencil has in
/// the direction of that motion. One that grows without oscillation becomes one that does so, too.
/// Throws NumericalError where it does not converge.
/// @source Ruhe, SIAM J. Numer. Anal. 10 (1973) 674-689, algorithm 4.8
ComplexMode compute_relaxing_mode(const RelaxingPencil& pencil, const ComplexMode& start);

}  // namespace culm::analysis
