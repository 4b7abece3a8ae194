/// Sparse matrices whose rows come in groups with the same columns: the unknowns of a node.
#pragma once

#include <culm/assembly/tpetra.hpp>

#include <span>
#include <vector>

namespace culm::solver {

/// Dense groups of rows over lists of columns, row by row.
class GroupedMatrix {
 public:
  GroupedMatrix() = default;
  /// Looks at the values of a matrix, which must stay. @param first_row of each group on this rank,
  /// and the end; the rows of a group must have the same columns
  GroupedMatrix(const assembly::CrsMatrix& matrix, std::vector<int> first_row);
  /// Owns its values. @param first_column of each group in the list of columns, and the end
  GroupedMatrix(std::vector<int> first_row, std::vector<std::size_t> first_column,
                std::vector<int> columns, std::vector<double> values);

  int groups() const { return static_cast<int>(first_row_.size()) - 1; }
  const std::vector<int>& first_row() const { return first_row_; }
  int height(int group) const;
  /// Local columns of a group.
  std::span<const int> columns(int group) const;
  /// Values of a group, row after row.
  const double* values(int group) const;

  /// y = A x. @param x values of all local columns
  void multiply(std::span<const double> x, std::span<double> y) const;
  /// The same with values that `round` left: half of the memory traffic.
  void multiply(std::span<const float> rounded, std::span<const double> x,
                std::span<double> y) const;
  /// The present values to single precision.
  void round(std::vector<float>& rounded) const;
  /// y += A^T A x, with one look at each value. @param x, y  of all local columns
  void add_projection(std::span<const double> x, std::span<double> y) const;
  /// x += A^T y.
  void add_transposed(std::span<const double> y, std::span<double> x) const;

 private:
  void gather(int group, std::span<const double> x, std::vector<double>& gathered) const;
  const double* all_values() const;
  template <class Number>
  void multiply_by(const Number* all, std::span<const double> x, std::span<double> y) const;

  std::vector<int> first_row_{0};
  std::vector<std::size_t> first_column_{0};
  std::vector<std::size_t> first_value_;
  std::vector<int> columns_;
  std::size_t widest_ = 0;  ///< columns of a group
  std::vector<double> own_values_;
  const double* borrowed_values_ = nullptr;
};

}  // namespace culm::solver
