/// The pattern of a matrix on one rank, put together from lists of entries.
#pragma once

#include <culm/assembly/tpetra.hpp>

#include "serial_matrix.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace culm::solver {

/// An entry of a row, and where its value comes from.
struct Entry {
  int column = 0;
  std::size_t source = 0;  ///< as the caller counts
};
/// Entries of each row.
using Lists = std::vector<std::vector<Entry>>;

/// Rows in order.
class SerialRows {
 public:
  /// The next row. Entries that are listed several times stand there once. @param visit (source,
  /// place among all entries)
  template <class Visit>
  void add(std::vector<Entry>& row, const Visit& visit) {
    std::ranges::stable_sort(row, {}, &Entry::column);
    for (const Entry& entry : row) {
      if (columns_.size() == begin_.back() || columns_.back() != entry.column) {
        columns_.push_back(entry.column);
      }
      visit(entry.source, columns_.size() - 1);
    }
    begin_.push_back(columns_.size());
  }
  const std::vector<std::size_t>& begin() const { return begin_; }
  const std::vector<int>& columns() const { return columns_; }
  Teuchos::RCP<assembly::CrsMatrix> make_matrix() const {
    return make_serial_matrix(begin_, columns_);
  }

 private:
  std::vector<std::size_t> begin_{0};
  std::vector<int> columns_;
};

}  // namespace culm::solver
