/// The linear solver of a matrix that is factored once.
#pragma once

#include <culm/solver/linear_solver.hpp>

#include <string>

namespace culm::solver {

/// As choose_linear_solver, but with KLU2 in the place of Block LU: speed is nothing then, and
/// searches for eigenvalues want all the digits that pivots can keep. Collective.
ChosenSolver choose_for_one_factorisation(const std::string& name,
                                          const std::shared_ptr<const assembly::Matrix>& matrix,
                                          const parallel::Comm& comm);

}  // namespace culm::solver
