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
/// Pivots inside blocks are not always enough. Where one is nothing but rounding, or the caller is
/// not content with a solution, KLU2 factors the matrix, and goes on with its pivots: they are the
/// only thing that depends on earlier factorisations. If it finds the matrix singular as well, then
/// blocks are tried again next time.
class GuardedBlockLu {
 public:
  /// The matrix stays with the caller.
  explicit GuardedBlockLu(const assembly::CrsMatrix& matrix) : matrix_(matrix), blocks_(matrix) {}

  /// Factors the present values. @return false if the matrix is singular to working precision
  bool factor();
  /// Factors the present values by KLU2 with new pivots. @return as factor()
  bool factor_anew();
  /// Whether the last factors are worth nothing before a solution shows that they serve.
  bool needs_proof() const { return !uses_klu2_ || klu2_->needs_proof(); }
  /// Puts A^-1 x into x with the last factors.
  void solve(std::span<double> x);
  /// Of the matrix that was factored last.
  Determinant determinant() const;

  /// Those of KLU2; empty as long as blocks serve.
  std::vector<int> pivots() const;
  /// The pivots at hand are those to which restore_pivots goes back.
  void remember_pivots();
  /// Goes back where others were chosen since.
  void restore_pivots();
  /// Goes on by KLU2 with such pivots, or by blocks without. @return false if they do not fit
  bool set_pivots(std::span<const int> pivots);

  /// How often KLU2 took over; empty if never.
  std::string remark() const;

 private:
  Klu2& klu2();

  const assembly::CrsMatrix& matrix_;
  BlockLu blocks_;
  std::optional<Klu2> klu2_;  ///< made when it is needed
  bool uses_klu2_ = false;
  bool used_klu2_ = false;  ///< when pivots were remembered
  long factorisations_ = 0;
  long by_klu2_ = 0;
};

}  // namespace culm::solver
