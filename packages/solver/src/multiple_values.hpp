/// One basis for the vectors of multiple eigenvalues.
#pragma once

#include <culm/solver/eigen_solver.hpp>

namespace culm::solver {

/// Vectors of a multiple value are any basis of their space, left to the method and its rounding.
/// This turns them within it: the unknown that moves most of all moves in the first vector only, of
/// those that remain the next one in the second only, and so on. What moves alike is ranked by its
/// number. So the vectors do not depend on method and number of ranks, and those of a round bar lie
/// along its axes. Values count as the same where rounding, or 1e-10 of them, separates them.
/// @param pairs values rising, vectors with x^T B x = 1
void align_multiple(EigenPairs& pairs);

}  // namespace culm::solver
