#include "whole_matrix.hpp"

namespace culm::analysis {

using assembly::Matrix;

Entries entries_of(const Matrix& matrix) {
  Entries entries;
  matrix.each_entry([&](std::size_t row, long long column, double value) {
    if (value == 0.0) return;
    entries.row.push_back(static_cast<int>(matrix.rows().global(row)));
    entries.column.push_back(static_cast<int>(column));
    entries.value.push_back(value);
  });
  return entries;
}

SparseMatrix whole(const Matrix& matrix, const parallel::Comm& comm) {
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
  const auto size = static_cast<int>(matrix.rows().total());
  SparseMatrix result(size, size);
  result.setFromTriplets(triplets.begin(), triplets.end());
  return result;
}

}  // namespace culm::analysis
