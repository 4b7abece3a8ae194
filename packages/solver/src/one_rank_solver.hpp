/// A solver that works on rank 0 alone.
#pragma once

#include <culm/assembly/tpetra.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/solver/linear_solver.hpp>

#include <functional>
#include <memory>

namespace culm::solver {

/// Makes a solver of a matrix that one rank has for itself.
using MakeSerialSolver = std::function<std::unique_ptr<LinearSolver>(
    const Teuchos::RCP<const assembly::CrsMatrix>& matrix, const parallel::Comm& alone)>;

/// Brings values to rank 0 in global order, and solutions back; where there is one rank, the serial
/// solver itself. Solutions are the same for any number of
/// ranks, and the same each time, also of solvers that sum up as messages come in. Collective.
std::unique_ptr<LinearSolver> make_one_rank_solver(
    const Teuchos::RCP<const assembly::CrsMatrix>& matrix, const MakeSerialSolver& make,
    const parallel::Comm& comm);

}  // namespace culm::solver
