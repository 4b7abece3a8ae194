/// Block LU as long as it serves, then KLU2.
#pragma once

#include "block_lu.hpp"
#include "klu2.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace culm::solver {

/// Factors of a matrix on one rank, with the operations of Klu2.
///
/// Pivots inside blocks are not always enough. Where a factorisation fails, or the caller is not
/// content with a solution, blocks choose their hosts anew; if that does not help, KLU2 factors the
/// matrix, and goes on with its pivots. Hosts or pivots are the only thing that depends on earlier
/// factorisations. A matrix that KLU2 finds singular as well leaves no trace.
class GuardedBlockLu {
 public:
  /// The matrix stays with the caller.
  explicit GuardedBlockLu(const assembly::CrsMatrix& matrix) : matrix_(matrix), blocks_(matrix) {}

  /// Factors the present values. @return false if the matrix is singular to working precision
  bool factor();
  /// The same, with the solution for b begun on the way where blocks serve.
  bool factor_for(std::span<const double> b);
  /// The solution that factor_for began, or all of it where it did not. @param x  b, in whose place
  /// it takes
  void finish(std::span<double> x);
  /// Factors the present values with new pivots of KLU2. @return as factor()
  bool factor_anew();
  /// Whether a solution must show that the last factors serve: each of blocks, as pivots come from
  /// one block only. @param has_solved whether there was a solution with them
  bool needs_proof(bool has_solved) const { return !uses_klu2_ || klu2_->needs_proof(has_solved); }
  /// Whether solutions are to be refined: those of blocks, where they leave more than rounding.
  bool wants_refinement() const { return !uses_klu2_; }
  /// Puts A^-1 x into x with the last factors.
  void solve(std::span<double> x);
  /// Of the matrix that was factored last.
  Determinant determinant() const;

  /// The pivots of KLU2, or -1 and the hosts of the blocks, as numbers for set_pivots of the same
  /// matrix pattern; empty before the first factorisation.
  std::vector<int> pivots() const;
  /// The pivots at hand are those to which restore_pivots goes back.
  void remember_pivots();
  /// Goes back where others were chosen since.
  void restore_pivots();
  /// Goes on with such numbers; without any it begins anew. @return false if they do not fit
  bool set_pivots(std::span<const int> pivots);

  /// How often KLU2 took over; empty if never.
  std::string remark() const;

 private:
  template <class FactorBlocks>
  bool factor_with(const FactorBlocks& factor_blocks);
  bool factor_with_other_hosts();
  bool factor_by_klu2(bool anew);
  void remember_once();
  Klu2& klu2();

  const assembly::CrsMatrix& matrix_;
  BlockLu blocks_;
  std::optional<Klu2> klu2_;  ///< made when it is needed
  bool uses_klu2_ = false;
  bool has_begun_ = false;                      ///< the solution that factor_for was given
  std::optional<std::vector<int>> remembered_;  ///< pivots before others were chosen; else none
  long factorisations_ = 0;
  long by_klu2_ = 0;
};

}  // namespace culm::solver
