/// MUMPS on several ranks, each with a part of its own.
#pragma once

#include <culm/assembly/tpetra.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/solver/linear_solver.hpp>

#include "dense_factors.hpp"
#include "mumps.hpp"
#include "ordering.hpp"
#include "substructures.hpp"

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace culm::solver {

/// Factors of a matrix that is cut between the ranks: each eliminates its interior by a MUMPS of
/// its own, and the root what that leaves of the interface, as a dense matrix (see
/// `Substructures`). Ranks wait for each other once in a factorisation, where one MUMPS on all of
/// them shares every large front, and rounding depends on nothing but the number of ranks. The
/// pattern must be symmetric.
class MumpsParts {
 public:
  MumpsParts(const Teuchos::RCP<const assembly::CrsMatrix>& matrix, const parallel::Comm& comm);

  /// Operations of the rank with the largest part, and of the root after it; infinite where what is
  /// between the parts is too large for one rank. Then there is nothing else to ask for.
  double operations() const { return operations_; }
  /// Factors the present values. @return false if a part cannot stand alone, or the matrix is
  /// singular. Throws NumericalError if the memory does not suffice. Collective, as all that
  /// follows.
  bool factor(Symmetry symmetry);
  /// x = A^-1 b.
  void solve(const Vector& b, Vector& x);
  /// Of the matrix that was factored last.
  Determinant determinant() const;
  std::string remark() const { return parts_.remark(); }

 private:
  bool factor_piece(Symmetry symmetry);
  bool factor_interface(Symmetry symmetry);

  parallel::Comm comm_;
  Substructures parts_;
  Ordering order_;  ///< of the piece
  double operations_ = std::numeric_limits<double>::infinity();
  std::optional<Mumps> piece_;  ///< none if this rank has no interior
  DenseFactors interface_;      ///< on the root, if there is one
  std::vector<double> x_;       ///< of the piece
  std::vector<double> interface_x_;
};

}  // namespace culm::solver
