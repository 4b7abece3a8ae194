/// Direct solution of the linear systems of a Newton iteration.
#pragma once

#include <culm/assembly/tpetra.hpp>

#include <memory>
#include <string>
#include <vector>

namespace culm::parallel {
class Comm;
}

namespace culm::solver {

using assembly::Vector;

/// Solves with one matrix whose pattern never changes and whose values do.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  virtual std::string name() const = 0;
  /// Factors the present values. @return false if the matrix is singular to working precision
  virtual bool factor() = 0;
  /// x = A^-1 b with the last factors. @return |b - A x| over the largest sum of terms of a row, in
  /// the maximum norm, the same on all ranks; above 1e-8 the factors are useless
  virtual double solve(const Vector& b, Vector& x) = 0;
  /// Approximates the direction in which A is weakest by inverse iteration on a slightly shifted
  /// copy. @return |A v| / |A| for the returned v of unit maximum norm; zero with v = 0 if not even
  /// the copy has factors, as with numbers that are not finite or differ too much in size
  virtual double weakest_direction(Vector& v) = 0;
};

/// Amesos2/KLU2 on rank 0. Values gather there in global order, so the factors, and the solution,
/// are the same for any number of ranks. The plan and the symbolic factorisation are made once.
/// Amesos2's own distributed path is avoided because KLU2 of Trilinos 13.2 as packaged by Debian
/// returns wrong solutions on several ranks (Trilinos pull request 12232).
std::unique_ptr<LinearSolver> make_rooted_klu2(
    const Teuchos::RCP<const assembly::CrsMatrix>& matrix, const parallel::Comm& comm);

/// MUMPS on all ranks, with rows where they are. Its ordering, nested dissection of the graph of
/// nodes, and its analysis are made once. Solutions are refined where the residual is above 1e-14.
/// On several ranks sums come together in an order that may change from run to run, and with it
/// the rounding.
std::unique_ptr<LinearSolver> make_mumps(const Teuchos::RCP<const assembly::CrsMatrix>& matrix,
                                         const parallel::Comm& comm);

/// A solver, and a sentence for reports: its name and why it was taken.
struct ChosenSolver {
  std::unique_ptr<LinearSolver> solver;
  std::string reason;
};

/// What decks may write, the default first.
const std::vector<std::string>& linear_solver_names();

/// The solver of that name. `Automatic` takes KLU2 for graphs like beams and MUMPS for graphs like
/// shells, whose factors are so dense that MUMPS gains by its dense kernels; it decides by
/// predict_fill. Collective.
ChosenSolver choose_linear_solver(const std::string& name,
                                  const Teuchos::RCP<const assembly::CrsMatrix>& matrix,
                                  const parallel::Comm& comm);

}  // namespace culm::solver
