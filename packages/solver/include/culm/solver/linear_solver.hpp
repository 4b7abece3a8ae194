/// Direct solution of the linear systems of a Newton iteration.
#pragma once

#include <culm/assembly/tpetra.hpp>

#include <memory>
#include <string>

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

}  // namespace culm::solver
