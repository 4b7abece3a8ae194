/// LU factors of dense blocks, for graphs like chains and trees.
#pragma once

#include <culm/base/large_vector.hpp>
#include <culm/mechanics/pack.hpp>
#include <culm/solver/linear_solver.hpp>

#include "block_plan.hpp"

#include <optional>
#include <span>
#include <vector>

namespace culm::solver {

/// LU factors of a matrix on one rank whose pattern never changes.
///
/// Rows with the same columns are a block. Blocks are eliminated whole, some together with a
/// neighbour (`find_hosts`), in an order that is planned once; pivots are chosen inside the
/// diagonal block only, so that nothing but numbers changes from one factorisation to the next, and
/// nothing is allocated. The hosts are chosen by the first values, and are the only thing that
/// depends on earlier factorisations.
///
/// The last rows may be kept: they are not eliminated, and `remainder` is what is left of them, as
/// for a part of a model that hangs on others by these unknowns.
class BlockLu {
 public:
  /// The matrix stays with the caller. @param kept rows at the end that are not eliminated; they
  /// form blocks of their own. @param cached  see `plan_blocks`
  explicit BlockLu(const BlockRows& rows, int kept = 0, std::size_t cached = cached_values);

  /// Factors the present values. @return false if a pivot is nothing but rounding or not a number,
  /// or entries grow too much; the matrix may yet have factors with other pivots
  bool factor();
  /// The same, and reduces x on the way, while the factors of each block are at hand; then
  /// `put_kept` and `extend` finish the solution. Large factors are not kept whole then, unless
  /// more was reduced by those before: that costs another factorisation, of the same values, which
  /// the matrix must still have.
  bool factor_and_reduce(std::span<const double> x);
  /// The same with hosts that are chosen by the present values.
  bool factor_with_new_hosts();
  /// Puts A^-1 x into x with the last factors, where no rows are kept.
  void solve(std::span<double> x);
  /// What is left of the rows and columns that are kept, row by row: with I eliminated and K kept,
  /// A_KK - A_KI A_II^-1 A_IK.
  std::span<const double> remainder() const;
  /// x_K - A_KI A_II^-1 x_I takes the place of x_K; first half of a solution.
  void reduce(std::span<double> x);
  /// What the last reduction leaves takes the place of x_K.
  void put_kept(std::span<double> x) const;
  /// With x_K found, A_II^-1 (x_I - A_IK x_K) takes the place of x_I that was reduced last.
  void extend(std::span<double> x);
  /// Of the matrix that was factored last; without what is kept.
  Determinant determinant() const;

  /// Of each block, see `find_hosts`; empty before the first factorisation.
  const std::vector<int>& hosts() const { return host_; }
  /// The next factorisation has these hosts, of a matrix with the same pattern; without any it
  /// chooses. @return false if they do not fit
  bool set_hosts(std::span<const int> host);

 private:
  static double* numbers_of(LargeVector<Packs<1>>& packs) {
    return reinterpret_cast<double*>(packs.data());
  }
  static const double* numbers_of(const LargeVector<Packs<1>>& packs) {
    return reinterpret_cast<const double*>(packs.data());
  }
  bool has_bench() const { return plan_.bench_size > 0; }
  double* bench() { return numbers_of(has_bench() ? bench_ : factors_); }
  const double* bench() const { return numbers_of(has_bench() ? bench_ : factors_); }
  double* factors() { return numbers_of(factors_); }
  const double* factors() const { return numbers_of(factors_); }
  // of those of a panel V, with its stride, and D and L where they stay
  struct Kept {
    const double* numbers;
    int stride;
  };
  Kept kept_V(const BlockPlan::Panel& p) const;
  struct Lower {
    const double* D;
    int stride;  // of D
    const double* L;
    std::span<const int> exchanged;  // of each row of D, the one it was exchanged with
  };
  Lower kept_lower(const BlockPlan::Panel& p);
  Lower made_lower(const BlockPlan::Panel& p);
  // D, L and exchanges are there for all panels
  bool is_whole() const { return keeps_lower_ || !has_bench(); }
  int* exchanged_rows(const BlockPlan::Panel& p) {
    return exchanged_.data() + (is_whole() ? p.first : 0);
  }
  using ToReduce = std::optional<std::span<const double>>;
  bool factor_numbers(const ToReduce& x);
  bool factor_with_chosen_hosts(const ToReduce& x);
  bool factor_and_merge(const std::vector<int>& hosts, double least, const ToReduce& x);
  bool factor_as_planned(double least, const ToReduce& x);
  void keep_lower(bool wanted);
  bool merge_failed();
  void plan();
  std::span<const BlockPlan::Panel> eliminated() const;
  BlockPlan::Panel before(const BlockPlan::Panel& panel) const;
  void fetch_before(const BlockPlan::Panel& panel);
  void fetch_kept_before(const BlockPlan::Panel& panel) const;
  void fill_before(const BlockPlan::Panel& panel);
  double start_at(std::size_t place) const;
  bool eliminate(const BlockPlan::Panel& panel, double least);
  void take(std::span<const double> x);
  template <class Size, class Width>
  void put_away(const BlockPlan::Panel& panel, Size size, Width width);
  void reduce_by(const BlockPlan::Panel& panel, const Lower& lower);
  bool has_grown(const BlockPlan::Panel& panel);
  double largest_in_row(int row) const;
  double largest_behind_joints(int row) const;
  void update(const BlockPlan::Panel& panel, std::size_t from);
  template <class Size, class Width>
  void substitute_forward(const BlockPlan::Panel& panel, Size size, Width width,
                          const Lower& lower);
  template <class Size>
  void put_solved(const BlockPlan::Panel& panel, Size size, std::span<double> x) const;
  template <class Size, class Width>
  void substitute_back(const BlockPlan::Panel& panel, Size size, Width width);

  BlockRows rows_;
  std::vector<int> block_of_;  ///< of each row
  int num_blocks_ = 0;
  int kept_ = 0;        ///< rows
  int first_kept_ = 0;  ///< block
  std::size_t cached_;
  std::vector<int> host_;
  BlockPlan plan_;
  const BlockPlan::Panel* failed_ = nullptr;  ///< whose pivots are nothing but rounding
  std::vector<BlockPlan::Place> diagonal_;    ///< by place: source of its entry; `no_place`
  std::vector<int> place_;                    ///< of each row
  LargeVector<Packs<1>> bench_;               ///< where panels are made, see BlockPlan
  LargeVector<Packs<1>> factors_;
  LargeVector<Packs<1>> lower_;      ///< D and L that come from a bench
  bool keeps_lower_ = true;          ///< of the factors that are there or being made
  bool reduces_again_ = false;       ///< these served more than the x that came with them
  std::vector<double> reciprocals_;  ///< by place: of pivots
  std::vector<double> before_;       ///< by place: largest size of the diagonal so far
  std::size_t noted_ = 0;            ///< places that `before_` knows
  /// By place: the row of the block it was exchanged with. Of one panel, where D is not kept.
  std::vector<int> exchanged_;
  int exchanges_ = 0;               ///< of all rows
  std::vector<double> x_;           ///< by place
  std::vector<double> beside_;      ///< of one panel
  std::vector<double> row_weight_;  ///< of one panel
  std::vector<Packs<1>> room_;      ///< of one panel
};

}  // namespace culm::solver
