/// Where the numbers of an item go: precomputed places in the owned rows of a CSR matrix.
#pragma once

#include <culm/math/fetch.hpp>
#include <culm/math/types.hpp>
#include <culm/model/unknowns.hpp>

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace culm::model {

/// The owned part of a linear system that batches add to. CSR, one row per owned unknown.
struct Target {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  std::span<double> residual;
  std::span<double> reactions;             ///< on unknowns that supports took away; may be empty
  std::span<double> values;                ///< CSR values; empty when no tangent is wanted
  std::span<const std::size_t> row_begin;  ///< CSR row pointers
  double force_scale = 0.0;                ///< largest force any item added
  double constraint_violation = 0.0;       ///< largest |h|, lengths over the model's length
  double multiplier_scale = 1.0;           ///< unknowns are multipliers / scale, rows times scale
  /// From where on the values are still those of another matrix; none where all are to be added to.
  std::size_t stale_from = none;

  /// Sets stale values to zero as far as they are added to next. So they are written while they are
  /// in the cache, where one pass over a large matrix before would drive them out of it again.
  void reach(std::size_t end) {
    if (end > stale_from) clear(end);
  }
  /// Sets all stale values to zero.
  void clear_rest() {
    if (stale_from != none) clear(values.size());
  }

 private:
  void clear(std::size_t end);
};

/// Adds six rows of `width` numbers to the rows of values that begin at `begin`.
template <int width>
void add_six_rows(const double* rows, const std::size_t* begin, double* values);

/// Places of the items of one batch. A block of unknowns is one contiguous run in every row of any
/// other block, so one offset per pair of blocks is enough; rows of other ranks have row -1.
class Scatter {
 public:
  /// Rows of one block of an item.
  struct Rows {
    int first = -1;  ///< local row of its first active unknown; -1 when not owned
    const BlockShape* shape = nullptr;
  };

  /// Appends an item. @param offsets run offsets within a row, one per pair (a, b), row by row
  void add_item(std::span<const Rows> rows, std::span<const int> offsets);

  /// First of the six rows of block a of an item, where it is a node of this rank and no support
  /// takes any away; -1 otherwise.
  int whole_node_row(std::size_t item, int a) const {
    const Rows& rows = rows_[first_block_[item] + static_cast<std::size_t>(a)];
    return rows.first >= 0 && is_node(*rows.shape) ? rows.first : -1;
  }

  /// Adds the residual of block a of an item; `values` has at least the width of the block.
  void add_residual(std::size_t item, int a, const double* values, Target& target) const {
    const Rows& rows = rows_[first_block_[item] + static_cast<std::size_t>(a)];
    if (rows.first < 0) return;
    double* out = target.residual.data() + rows.first;
    fetch_to_write(out + rows_ahead, sizeof(double));
    if (is_node(*rows.shape)) {
      Eigen::Map<Vec6>(out) += Eigen::Map<const Vec6>(values);
      return;
    }
    for (int i = 0; i < rows.shape->width; ++i) {
      const int at = rows.shape->position[static_cast<std::size_t>(i)];
      if (at >= 0) {
        out[at] += values[i];
      } else if (!target.reactions.empty()) {
        target.reactions[static_cast<std::size_t>(rows.shape->first_reaction - 1 - at)] +=
            values[i];
      }
    }
  }

  /// Adds the tangent of blocks (a, b) of an item; shape at least (width of a, width of b), what is
  /// beyond is left out.
  template <class Derived>
  void add_tangent(std::size_t item, int a, int b, const Eigen::MatrixBase<Derived>& K,
                   Target& target) const {
    const std::size_t first = first_block_[item];
    const Rows& rows = rows_[first + static_cast<std::size_t>(a)];
    if (rows.first < 0) return;
    const BlockShape& row_shape = *rows.shape;
    const BlockShape& column_shape = *rows_[first + static_cast<std::size_t>(b)].shape;
    const auto blocks = static_cast<int>(first_block_[item + 1] - first);
    const int offset = offsets_[first_pair_[item] + static_cast<std::size_t>(a * blocks + b)];
    target.reach(target.row_begin[static_cast<std::size_t>(rows.first + row_shape.active)]);
    if (is_node(row_shape) && is_node(column_shape)) {
      const std::size_t* row = target.row_begin.data() + rows.first;
      for (int i = 0; i < 6; ++i) {
        Eigen::Map<RowMat<1, 6>>(target.values.data() + row[i] + offset) +=
            K.row(i).template head<6>();
      }
      return;
    }
    constexpr int rows_of_K = Derived::RowsAtCompileTime;
    constexpr int columns_of_K = Derived::ColsAtCompileTime;
    if constexpr (rows_of_K != Eigen::Dynamic && columns_of_K != Eigen::Dynamic) {
      const bool is_whole = row_shape.full() && row_shape.width == rows_of_K &&
                            column_shape.full() && column_shape.width == columns_of_K;
      if (is_whole) {
        const std::size_t* row = target.row_begin.data() + rows.first;
        for (int i = 0; i < rows_of_K; ++i) {
          double* out = target.values.data() + row[i] + offset;
          for (int j = 0; j < columns_of_K; ++j) out[j] += K(i, j);
        }
        return;
      }
    }
    for (int i = 0; i < row_shape.width; ++i) {
      const int row = row_shape.position[static_cast<std::size_t>(i)];
      if (row < 0) continue;
      double* out = target.values.data() +
                    target.row_begin[static_cast<std::size_t>(rows.first + row)] + offset;
      if (column_shape.full()) {
        for (int j = 0; j < column_shape.width; ++j) out[j] += K(i, j);
      } else {
        for (int j = 0; j < column_shape.width; ++j) {
          const int column = column_shape.position[static_cast<std::size_t>(j)];
          if (column >= 0) out[column] += K(i, j);
        }
      }
    }
  }

  /// The same for the blocks of a and of all N blocks of an item, side by side in the rows of K of
  /// the shape (6, 6 N), all of them nodes with six unknowns.
  template <int N>
  void add_tangent_rows(std::size_t item, int a, const double* K, Target& target) const {
    const std::size_t first = first_block_[item];
    const Rows& rows = rows_[first + static_cast<std::size_t>(a)];
    if (rows.first < 0) return;
    const int* offsets = offsets_.data() + first_pair_[item] + N * a;
    bool side_by_side = is_node(*rows.shape);
    for (int b = 0; b < N; ++b) {
      side_by_side = side_by_side && offsets[b] == offsets[0] + 6 * b &&
                     is_node(*rows_[first + static_cast<std::size_t>(b)].shape);
    }
    if (!side_by_side) {
      const Eigen::Map<const RowMat<6, 6 * N>> all(K);
      for (int b = 0; b < N; ++b) {
        add_tangent(item, a, b, all.template middleCols<6>(6 * b), target);
      }
      return;
    }
    target.reach(target.row_begin[static_cast<std::size_t>(rows.first + 6)]);
    add_six_rows<6 * N>(K, target.row_begin.data() + rows.first, target.values.data() + offsets[0]);
  }

  std::size_t size() const { return first_block_.size() - 1; }

 private:
  static constexpr int rows_ahead = 128;  ///< that other items will be added to
  static bool is_node(const BlockShape& shape) { return shape.full() && shape.width == 6; }

  std::vector<Rows> rows_;
  std::vector<int> offsets_;
  std::vector<std::size_t> first_block_{0};
  std::vector<std::size_t> first_pair_{0};
};

}  // namespace culm::model
