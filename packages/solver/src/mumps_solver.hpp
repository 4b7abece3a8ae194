/// MUMPS as a linear solver, with an ordering that is known already.
#pragma once

#include <culm/solver/linear_solver.hpp>

#include "ordering.hpp"

namespace culm::solver {

std::unique_ptr<LinearSolver> make_mumps(const Teuchos::RCP<const assembly::CrsMatrix>& matrix,
                                         Ordering ordering, const parallel::Comm& comm);

}  // namespace culm::solver
