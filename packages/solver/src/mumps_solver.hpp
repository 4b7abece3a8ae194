/// MUMPS as a linear solver, with an ordering that is known already.
#pragma once

#include <culm/solver/linear_solver.hpp>

#include "ordering.hpp"

namespace culm::solver {

std::unique_ptr<LinearSolver> make_mumps(const Teuchos::RCP<const assembly::CrsMatrix>& matrix,
                                         Ordering ordering, const parallel::Comm& comm);
/// On several ranks, where the pattern is symmetric: in parts where that is less work for the rank
/// that has the most, until a part cannot stand alone or a solution leaves more than 1e-12.
std::unique_ptr<LinearSolver> make_shared_mumps(
    const Teuchos::RCP<const assembly::CrsMatrix>& matrix, Ordering ordering,
    const parallel::Comm& comm);

}  // namespace culm::solver
