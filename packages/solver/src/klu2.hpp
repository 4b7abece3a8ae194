/// KLU2 of Amesos2 called directly, because Amesos2's adapter cannot factor again with the pivots
/// that it has.
#pragma once

#include <culm/assembly/tpetra.hpp>
#include <culm/solver/linear_solver.hpp>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace culm::solver {

/// LU factors of a matrix on one rank whose pattern never changes.
///
/// The first factorisation chooses the pivots, by size and sparsity. Later ones keep them, and with
/// them the pattern of the factors, which takes a fifth of the time; if entries grow too much they
/// choose anew. Which pivots serve is the only thing that depends on earlier factorisations.
class Klu2 {
 public:
  /// The matrix stays with the caller. Its pattern is analysed here.
  explicit Klu2(const assembly::CrsMatrix& matrix);
  ~Klu2();
  Klu2(const Klu2&) = delete;
  Klu2& operator=(const Klu2&) = delete;

  /// Factors the present values. @return false if the matrix is singular to working precision
  bool factor();
  /// Factors the present values with new pivots. @return as factor()
  bool factor_anew();
  /// Whether a solution must show that the last factors serve: they have the pivots of an earlier
  /// matrix, and none has shown it. @param has_solved whether there was a solution with them
  bool needs_proof(bool has_solved) const { return kept_pivots_ && !has_solved; }
  /// Whether solutions are to be refined: never, as pivots are good or chosen anew.
  bool wants_refinement() const { return false; }
  /// Puts A^-1 x into x with the last factors.
  void solve(std::span<double> x);

  /// Of the matrix that was factored last.
  Determinant determinant() const;

  /// Which unknown is eliminated with which row, as numbers for set_pivots of the same matrix
  /// pattern; empty without factors.
  std::vector<int> pivots() const;
  /// The pivots at hand are those to which restore_pivots goes back.
  void remember_pivots() { remembered_.reset(); }
  /// Goes back where others were chosen since.
  void restore_pivots();
  /// The next factorisation keeps these pivots. It then rounds as it would have after those that
  /// chose them; without any it chooses. @return false if they are not pivots of a matrix of this
  /// size
  bool set_pivots(std::span<const int> pivots);

 private:
  struct Parts;
  void scale();
  bool choose_pivots();
  bool keep_pivots();

  const assembly::CrsMatrix& matrix_;
  std::unique_ptr<Parts> parts_;
  std::vector<int> begin_;
  std::vector<int> entries_;
  std::vector<double> values_;  ///< of the matrix, each column divided by its largest entry
  std::vector<double> scale_;   ///< by column
  bool kept_pivots_ = false;
  std::optional<std::vector<int>> remembered_;  ///< those before others were chosen; else none
};

}  // namespace culm::solver
