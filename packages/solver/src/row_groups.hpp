/// Rows of a sparse matrix that come in groups with the same columns: the unknowns of a node.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace culm::solver {

/// Where the values of such a matrix belong; they are dense in each group, row after row, and kept
/// elsewhere. Lists of columns are short where columns stand together, as those of a node do.
class RowGroups {
 public:
  RowGroups() = default;
  /// @param first_row of each group, and the end @param first_column of each group in the list of
  /// columns, and the end
  RowGroups(std::vector<int> first_row, std::vector<std::size_t> first_column,
            std::vector<int> columns);

  int groups() const { return static_cast<int>(first_row_.size()) - 1; }
  const std::vector<int>& first_row() const { return first_row_; }
  int height(int group) const;
  /// Local columns of a group.
  std::span<const int> columns(int group) const;
  /// Of a group; of their number, the values of all.
  std::size_t first_value(int group) const { return first_value_[static_cast<std::size_t>(group)]; }

  /// y = A x. @param x values of all local columns
  void multiply(const double* values, std::span<const double> x, std::span<double> y) const;
  /// y += A x.
  void add_product(const double* values, std::span<const double> x, std::span<double> y) const;
  /// y = b - A x. @param b  may be y
  void subtract_product(const float* values, std::span<const double> x, std::span<const double> b,
                        std::span<double> y) const;
  /// x += A^T y.
  void add_transposed(const double* values, std::span<const double> y, std::span<double> x) const;
  /// y += A^T A x, with one look at each value. @param x, y  of all local columns
  void add_projection(const float* values, std::span<const double> x, std::span<double> y) const;

  /// Columns that follow each other.
  struct Run {
    int first = 0;
    int count = 0;
  };

 private:
  std::span<const Run> runs(int group) const;

  std::vector<int> first_row_{0};
  std::vector<std::size_t> first_column_{0};
  std::vector<int> columns_;
  std::vector<std::size_t> first_value_{0};
  std::vector<std::size_t> first_run_{0};
  std::vector<Run> runs_;
  std::size_t widest_ = 0;   ///< columns of a group
  std::size_t highest_ = 0;  ///< rows of a group
};

}  // namespace culm::solver
