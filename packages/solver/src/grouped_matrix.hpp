/// Sparse matrices by groups of rows with the same columns.
#pragma once

#include <culm/assembly/tpetra.hpp>

#include "row_groups.hpp"

#include <memory>
#include <span>
#include <vector>

namespace culm::solver {

/// Values in double precision.
class GroupedMatrix {
 public:
  GroupedMatrix() = default;
  /// Looks at the values of a matrix, which must stay. @param first_row of each group on this rank,
  /// and the end; the rows of a group must have the same columns
  GroupedMatrix(const assembly::CrsMatrix& matrix, std::vector<int> first_row);
  /// Owns its values.
  GroupedMatrix(RowGroups layout, std::vector<double> values);

  const std::shared_ptr<const RowGroups>& layout() const { return layout_; }
  int groups() const { return layout_->groups(); }
  const std::vector<int>& first_row() const { return layout_->first_row(); }
  int height(int group) const { return layout_->height(group); }
  std::span<const int> columns(int group) const { return layout_->columns(group); }
  /// Values of a group, row after row.
  const double* values(int group) const {
    return all_values().data() + layout_->first_value(group);
  }
  /// Those of all groups.
  std::span<const double> all_values() const;
  /// y = A x. @param x values of all local columns
  void multiply(std::span<const double> x, std::span<double> y) const;
  /// y += A x.
  void add_product(std::span<const double> x, std::span<double> y) const;
  /// x += A^T y.
  void add_transposed(std::span<const double> y, std::span<double> x) const;

 private:
  std::shared_ptr<const RowGroups> layout_;
  std::vector<double> own_values_;
  const double* borrowed_values_ = nullptr;
};

/// Values in single precision: half of the memory, and of what products have to read.
class RoundedMatrix {
 public:
  RoundedMatrix() = default;
  RoundedMatrix(RowGroups layout, std::vector<float> values);

  /// Becomes a copy of a matrix with its present values.
  void copy(const GroupedMatrix& matrix);
  /// y = b - A x. @param x values of all local columns @param b  may be y
  void subtract_product(std::span<const double> x, std::span<const double> b,
                        std::span<double> y) const;
  /// y += A^T A x, with one look at each value. @param x, y  of all local columns
  void add_projection(std::span<const double> x, std::span<double> y) const;

 private:
  std::shared_ptr<const RowGroups> layout_;
  std::vector<float> values_;
};

}  // namespace culm::solver
