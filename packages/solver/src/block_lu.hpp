/// LU factors of dense blocks, for graphs like chains and trees.
#pragma once

#include <culm/solver/linear_solver.hpp>

#include "block_plan.hpp"

#include <span>
#include <vector>

namespace culm::solver {

/// LU factors of a matrix on one rank whose pattern never changes.
///
/// Blocks of unknowns are eliminated whole, in an order that is planned once; pivots are chosen
/// inside the diagonal block only, so that nothing but numbers changes from one factorisation to
/// the next, and nothing is allocated. What is hollow (`order_groups`) follows from the values; if
/// it changes, the plan is made anew. Nothing depends on earlier factorisations.
class BlockLu {
 public:
  /// The matrix stays with the caller.
  explicit BlockLu(const assembly::CrsMatrix& matrix);

  /// Factors the present values. @return false if a pivot is nothing but rounding or not a number;
  /// the matrix may yet have factors with other pivots
  bool factor();
  /// Puts A^-1 x into x with the last factors.
  void solve(std::span<double> x);
  /// Of the matrix that was factored last.
  Determinant determinant() const;

 private:
  bool find_hollow_rows(const double* values);
  void plan();
  void copy(const double* values);
  bool eliminate(const BlockPlan::Panel& panel);
  template <class Size>
  bool factor_panel(const BlockPlan::Panel& panel, Size size);
  void update(const BlockPlan::Panel& panel, std::size_t from);

  const assembly::CrsMatrix& matrix_;
  assembly::CrsMatrix::local_matrix_host_type local_;  ///< of it; to ask for it allocates
  struct Row {
    std::size_t diagonal = 0;  ///< its entry on the diagonal; `none` if the graph has none
    std::size_t first = 0;     ///< its entries in the diagonal block …
    std::size_t last = 0;      ///< … and their end
  };
  std::vector<Row> rows_;
  std::vector<bool> is_hollow_;
  BlockPlan plan_;
  std::vector<double> values_;
  std::vector<double> least_;  ///< of each pivot, by place: what rounding may leave of the diagonal
  std::vector<int> exchanged_;  ///< by place: the row of the block it was exchanged with
  std::vector<double> x_;       ///< by place
  std::vector<double> beside_;  ///< of one panel
};

}  // namespace culm::solver
