/// Block LU on several ranks.
#pragma once

#include <culm/solver/linear_solver.hpp>

namespace culm::solver {

/// Each rank eliminates the unknowns that only its own rows know, as `BlockLu` does; what that
/// leaves between the ranks is factored on the root. Nothing whole is on any rank. Where a part
/// cannot stand alone, as one that hangs on others by joints only, or a solution leaves more than
/// 1e-12, Block LU of the whole matrix on the root takes over. The pattern must be symmetric.
/// Solutions depend on the number of ranks by rounding. Collective.
std::unique_ptr<LinearSolver> make_substructured(
    const std::shared_ptr<const assembly::Matrix>& matrix, const parallel::Comm& comm);

}  // namespace culm::solver
