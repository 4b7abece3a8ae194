/// One instance of MUMPS, through its C interface.
#pragma once

#include <culm/assembly/tpetra.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/solver/linear_solver.hpp>

#include <dmumps_c.h>

#include <memory>
#include <span>
#include <vector>

namespace culm::solver {

/// What the values of a matrix are like.
enum class Symmetry { none, symmetric };

/// LU factors of an unsymmetric matrix that stays distributed by rows, or L D L^T of a symmetric
/// one, which need not be definite, in half the time. All calls are collective, and outcomes and
/// errors are the same on all ranks, because MUMPS shares its first error.
class Mumps {
 public:
  /// @param symmetry of all matrices that will come; of symmetric ones the lower triangle is read
  /// @param place of each global row among the pivots; on the root only
  Mumps(const assembly::CrsMatrix& pattern, Symmetry symmetry, std::vector<int> place,
        const parallel::Comm& comm);
  ~Mumps();
  Mumps(const Mumps&) = delete;
  Mumps& operator=(const Mumps&) = delete;

  Symmetry symmetry() const { return symmetry_; }
  /// Factors the values of a matrix with the pattern; analyses it first if that is still to do.
  /// @return false if a pivot is zero. Throws NumericalError if the memory does not suffice.
  bool factor(const assembly::CrsMatrix& matrix);
  /// Of the matrix that was factored last.
  Determinant determinant() const;
  /// Replaces b by A^-1 b, whole and in global order, on the root.
  void solve(std::span<double> b);

 private:
  void pass_values(const assembly::CrsMatrix& matrix);
  void run(int job);
  /// In memory of ours, which MUMPS would take from the system and give back for each matrix.
  void factor_in_workspace();
  bool has_run_out_of_workspace() const;
  void throw_error() const;

  DMUMPS_STRUC_C mumps_{};
  Symmetry symmetry_;
  std::vector<std::size_t> lower_;  ///< entries of this rank that are passed; of symmetric matrices
  std::vector<double> values_;      ///< their values
  std::vector<MUMPS_INT> rows_;     ///< of the entries of this rank, from 1
  std::vector<MUMPS_INT> columns_;  ///< likewise
  std::vector<MUMPS_INT> pivots_;   ///< place of each row, from 1; on the root
  std::unique_ptr<double[]> workspace_;  ///< where MUMPS factors; factors stay there
  bool analysed_ = false;
};

}  // namespace culm::solver
