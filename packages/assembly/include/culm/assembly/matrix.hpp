/// Sparse matrices whose rows are spread over ranks.
#pragma once

#include <culm/assembly/vector.hpp>

#include <Eigen/SparseCore>

#include <memory>
#include <span>
#include <vector>

namespace culm::assembly {

/// Where a matrix may have entries: found once, shared by all matrices of a system.
class Pattern {
 public:
  struct Stored;

  /// @param begin  where the entries of each row of this rank begin; one more than there are rows
  /// @param column_of  number among `columns` of each entry, rising in each row
  Pattern(const Rows& rows, const Rows& columns, std::span<const std::size_t> begin,
          std::span<const int> column_of);
  explicit Pattern(std::shared_ptr<const Stored> stored);
  const Stored& stored() const { return *stored_; }

 private:
  std::shared_ptr<const Stored> stored_;
};

/// Of each row the first of its columns where they follow each other without a gap, otherwise -1.
/// It takes the place of all of them where rows are read often and memory sets the pace.
std::vector<int> first_columns(std::span<const std::size_t> row_begin,
                               std::span<const int> column_of);

/// Rows of this rank as arrays, one after the other. Columns are numbered on each rank; columns()
/// tells their global numbers. Copies have values of their own and share the pattern.
class Matrix {
 public:
  struct Stored;

  explicit Matrix(const Pattern& pattern);  ///< zeros
  explicit Matrix(std::unique_ptr<Stored> stored);
  /// The rows of this rank of a matrix that is whole on every rank. Collective.
  Matrix(const Rows& rows, const Eigen::SparseMatrix<double>& whole);
  Matrix(const Matrix& other);
  Matrix& operator=(const Matrix&) = delete;
  ~Matrix();

  const Rows& rows() const;
  const Rows& columns() const;
  std::size_t total_entries() const;  ///< on all ranks
  std::span<double> values() { return values_; }
  std::span<const double> values() const { return values_; }
  /// Where the entries of each row of this rank begin; one more than there are rows.
  std::span<const std::size_t> row_begin() const { return row_begin_; }
  /// Number among columns() of each entry.
  std::span<const int> column_of() const { return column_of_; }
  /// Calls action(row, column, value) for each entry of this rank, by the place of its row here and
  /// the global number of its column.
  template <class Action>
  void each_entry(const Action& action) const {
    for (std::size_t row = 0; row + 1 < row_begin_.size(); ++row) {
      for (std::size_t k = row_begin_[row]; k < row_begin_[row + 1]; ++k) {
        action(row, columns().global(static_cast<std::size_t>(column_of_[k])), values_[k]);
      }
    }
  }
  /// Of the rows of this rank; zero where there is no entry.
  std::vector<double> diagonal() const;
  /// y = A x. Collective.
  void multiply(const Vector& x, Vector& y) const;
  /// Root of the sum of squares of all entries. Collective.
  double norm() const;
  Stored& stored() { return *stored_; }
  const Stored& stored() const { return *stored_; }

 private:
  std::unique_ptr<Stored> stored_;
  std::span<double> values_;
  std::span<const std::size_t> row_begin_;
  std::span<const int> column_of_;
};

}  // namespace culm::assembly
