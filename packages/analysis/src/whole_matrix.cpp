#include "whole_matrix.hpp"

namespace culm::analysis {

using assembly::CrsMatrix;

Entries entries_of(const CrsMatrix& matrix) {
  Entries entries;
  const auto local = matrix.getLocalMatrixHost();
  for (std::size_t r = 0; r < static_cast<std::size_t>(local.numRows()); ++r) {
    for (auto k = local.graph.row_map(r); k < local.graph.row_map(r + 1); ++k) {
      if (local.values(k) == 0.0) continue;
      entries.row.push_back(
          static_cast<int>(matrix.getRowMap()->getGlobalElement(static_cast<int>(r))));
      entries.column.push_back(
          static_cast<int>(matrix.getColMap()->getGlobalElement(local.graph.entries(k))));
      entries.value.push_back(local.values(k));
    }
  }
  return entries;
}

SparseMatrix whole(const CrsMatrix& matrix, const parallel::Comm& comm) {
  const Entries mine = entries_of(matrix);
  const auto rows = comm.gather(std::span<const int>(mine.row));
  const auto columns = comm.gather(std::span<const int>(mine.column));
  const auto values = comm.gather(std::span<const double>(mine.value));
  const auto count = static_cast<std::size_t>(comm.sum(static_cast<double>(mine.value.size())));
  std::vector<double> all(3 * count);  // row, column, value; numbers of rows are exact
  for (std::size_t k = 0; k < values.size(); ++k) {
    all[3 * k] = rows[k];
    all[3 * k + 1] = columns[k];
    all[3 * k + 2] = values[k];
  }
  comm.broadcast(all);
  std::vector<Eigen::Triplet<double>> triplets;
  for (std::size_t k = 0; k < count; ++k) {
    triplets.emplace_back(static_cast<int>(all[3 * k]), static_cast<int>(all[3 * k + 1]),
                          all[3 * k + 2]);
  }
  const auto size = static_cast<int>(matrix.getGlobalNumRows());
  SparseMatrix result(size, size);
  result.setFromTriplets(triplets.begin(), triplets.end());
  return result;
}

Teuchos::RCP<const CrsMatrix> distribute(const SparseMatrix& matrix,
                                         const Teuchos::RCP<const assembly::Map>& rows) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = matrix;
  std::size_t widest = 0;
  for (int row = 0; row < by_rows.rows(); ++row) {
    widest = std::max(widest, static_cast<std::size_t>(by_rows.innerVector(row).nonZeros()));
  }
  const auto result = Teuchos::rcp(new CrsMatrix(rows, widest));
  std::vector<assembly::GlobalIndex> columns;
  std::vector<double> values;
  for (std::size_t local = 0; local < rows->getNodeNumElements(); ++local) {
    const auto row = rows->getGlobalElement(static_cast<int>(local));
    columns.clear();
    values.clear();
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(by_rows, row); entry;
         ++entry) {
      columns.push_back(entry.col());
      values.push_back(entry.value());
    }
    result->insertGlobalValues(row, Teuchos::arrayViewFromVector(columns),
                               Teuchos::arrayViewFromVector(values));
  }
  result->fillComplete(rows, rows);
  return result;
}

}  // namespace culm::analysis
