/// One instance of MUMPS, through its C interface.
#pragma once

#include <culm/assembly/tpetra.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/solver/linear_solver.hpp>

#include "block_rows.hpp"
#include "symmetry.hpp"

#include <dmumps_c.h>

#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

namespace culm::solver {

/// LU factors of an unsymmetric matrix that stays distributed by rows, or L D L^T of a symmetric
/// one, which need not be definite, in half the time. All calls are collective, and outcomes and
/// errors are the same on all ranks, because MUMPS shares its first error.
///
/// The last rows of a matrix on one rank may be kept, as by `BlockLu`: they are not eliminated.
class Mumps {
 public:
  /// @param symmetry of all matrices that will come; of symmetric ones the lower triangle is read
  /// @param place of each global row among the pivots; on the root only
  Mumps(const assembly::CrsMatrix& pattern, Symmetry symmetry, std::vector<int> place,
        const parallel::Comm& comm);
  /// On this rank alone. @param kept rows at the end that are not eliminated, in place, too
  Mumps(const BlockRows& pattern, int kept, Symmetry symmetry, std::vector<int> place);
  ~Mumps();
  Mumps(const Mumps&) = delete;
  Mumps& operator=(const Mumps&) = delete;

  Symmetry symmetry() const { return symmetry_; }
  /// Factors the values of a matrix with the pattern; analyses it first if that is still to do.
  /// @return false if a pivot is zero. Throws NumericalError if the memory does not suffice.
  bool factor(const BlockRows& matrix);
  /// Of the matrix that was factored last; without what is kept.
  Determinant determinant() const;
  /// Replaces b by A^-1 b, whole and in global order, on the root. No rows are kept.
  void solve(std::span<double> b);
  /// What is left of the rows and columns that are kept, row by row: with I eliminated and K kept,
  /// A_KK - A_KI A_II^-1 A_IK.
  std::span<const double> remainder() const { return remainder_; }
  /// x_K - A_KI A_II^-1 x_I takes the place of x_K; first half of a solution.
  void reduce(std::span<double> x);
  /// With x_K found, A_II^-1 (x_I - A_IK x_K) takes the place of x_I that was reduced last.
  void extend(std::span<double> x);

 private:
  void start(int rows, const parallel::Comm& comm);
  template <class RowNumber, class ColumnNumber>
  void take_pattern(const BlockRows& pattern, const RowNumber& row_number,
                    const ColumnNumber& column_number);
  void keep(int rows);
  void pass_values(const BlockRows& matrix);
  void solve_half(int half, std::span<double> x);
  void fill_upper_triangle();
  void run(int job);
  /// In memory of ours, which MUMPS would take from the system and give back for each matrix.
  void factor_in_workspace();
  bool has_run_out_of_workspace() const;
  void throw_error() const;

  DMUMPS_STRUC_C mumps_{};
  Symmetry symmetry_;
  std::vector<std::size_t> sources_;  ///< of the entries of this rank; none: as they stand
  std::vector<double> values_;        ///< from there
  std::vector<MUMPS_INT> rows_;       ///< of the entries of this rank, from 1
  std::vector<MUMPS_INT> columns_;    ///< likewise
  std::vector<MUMPS_INT> pivots_;     ///< place of each row, from 1; on the root
  std::vector<MUMPS_INT> kept_;       ///< rows, from 1
  std::vector<double> remainder_;
  std::vector<double> reduced_;  ///< right-hand side of the kept rows, then solution
  // not by operator new: no memory here is no end of the program
  struct Free {
    void operator()(double* numbers) const { std::free(numbers); }
  };
  std::unique_ptr<double[], Free> workspace_;  ///< where MUMPS factors; factors stay there
  bool analysed_ = false;
};

}  // namespace culm::solver
