/// Follower forces that are little beside stiffnesses, but not beside what resists the modes.
#pragma once

#include "whole_matrix.hpp"

#include <span>

namespace culm::analysis {

/// Whether modes that were found as those of a symmetric tangent miss what of it is not symmetric:
/// |(K - K^T) phi| in the norm of the inverse masses on the diagonal against lambda, for
/// phi^T M phi = 1. Entries that differ by rounding do not count.
/// @param squares  lambda; where it is zero nothing resists @param modes  phi, a column each
bool hides_asymmetry(const SparseMatrix& stiffness, const SparseMatrix& mass,
                     std::span<const double> squares, const Eigen::MatrixXd& modes);

}  // namespace culm::analysis
