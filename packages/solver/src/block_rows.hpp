/// The rows of a matrix as factors of dense blocks read them.
#pragma once

#include <culm/assembly/tpetra.hpp>

#include <cstddef>
#include <vector>

namespace culm::solver {

/// Part of the rows of a matrix, under other numbers, and rows that were added to them.
struct PartOfRows {
  std::vector<int> rows;   ///< local rows of the matrix, in the order of the part
  std::vector<int> place;  ///< of each local column of the matrix in the part; -1 outside
  /// Of each added row, and the end: its entries in columns and values.
  std::vector<std::size_t> begin{0};
  std::vector<int> columns;  ///< in the part
  std::vector<double> values;
};

/// A square matrix on one rank whose values stay where they are: rows and columns have one
/// numbering, and each entry a source, which tells where its value stands. The sources of a row
/// follow each other; those of the next row need not.
class BlockRows {
 public:
  /// All rows of a matrix of one rank.
  BlockRows(const assembly::CrsMatrix& matrix)  // NOLINT(google-explicit-constructor)
      : local_(matrix.getLocalMatrixHost()) {}
  /// @param part  stays with the caller
  BlockRows(const assembly::CrsMatrix& matrix, const PartOfRows& part)
      : local_(matrix.getLocalMatrixHost()), part_(&part) {}

  int size() const {
    return static_cast<int>(part_ != nullptr ? part_->rows.size() + part_->begin.size() - 1
                                             : local_.graph.row_map.extent(0) - 1);
  }

  /// Calls visit(column, source) for the entries of a row.
  template <class Visit>
  void for_entries(int row, const Visit& visit) const {
    const auto number = static_cast<std::size_t>(row);
    if (part_ == nullptr) {
      for_stored(number, [&](int column, std::size_t k) { visit(column, k); });
    } else if (number < part_->rows.size()) {
      for_stored(static_cast<std::size_t>(part_->rows[number]), [&](int column, std::size_t k) {
        visit(part_->place[static_cast<std::size_t>(column)], k);
      });
    } else {
      const std::size_t added = number - part_->rows.size();
      for (std::size_t k = part_->begin[added]; k < part_->begin[added + 1]; ++k) {
        visit(part_->columns[k], stored() + k);
      }
    }
  }

  /// The values of this source and of those that follow it in its row.
  const double* values(std::size_t source) const {
    return source < stored() ? local_.values.data() + source
                             : part_->values.data() + (source - stored());
  }
  double value(std::size_t source) const { return *values(source); }

 private:
  std::size_t stored() const { return local_.values.extent(0); }

  template <class Visit>
  void for_stored(std::size_t row, const Visit& visit) const {
    const auto& graph = local_.graph;
    for (auto k = graph.row_map(row); k < graph.row_map(row + 1); ++k) {
      visit(graph.entries(k), static_cast<std::size_t>(k));
    }
  }

  assembly::CrsMatrix::local_matrix_host_type local_;  // to ask for it allocates
  const PartOfRows* part_ = nullptr;
};

}  // namespace culm::solver
