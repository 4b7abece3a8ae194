#include "rooted_matrix.hpp"

#include "serial_matrix.hpp"

#include <algorithm>
#include <numeric>

namespace culm::solver {

using assembly::CrsMatrix;
using assembly::Vector;

RootedMatrix::RootedMatrix(Teuchos::RCP<const CrsMatrix> matrix, const parallel::Comm& comm)
    : distributed_(std::move(matrix)),
      comm_(comm),
      rows_(assembly::rows_of(distributed_->getRowMap()), comm) {
  if (comm_.size() == 1) {
    // only read, but Amesos2 and the shifted copy want a common type
    serial_ = Teuchos::rcp_const_cast<CrsMatrix>(distributed_);
    rhs_.emplace(assembly::rows_of(serial_->getRowMap()));
    solution_.emplace(rhs_->rows());
    return;
  }
  plan_gather();
}

void RootedMatrix::plan_gather() {
  const auto local = distributed_->getLocalMatrixHost();
  const auto rows_here = static_cast<std::size_t>(local.numRows());
  std::vector<int> counts(rows_here);
  std::vector<long long> columns;
  for (std::size_t r = 0; r < rows_here; ++r) {
    counts[r] = static_cast<int>(local.graph.row_map(r + 1) - local.graph.row_map(r));
    for (auto k = local.graph.row_map(r); k < local.graph.row_map(r + 1); ++k) {
      columns.push_back(distributed_->getColMap()->getGlobalElement(local.graph.entries(k)));
    }
  }
  value_funnel_ = parallel::Funnel(comm_, static_cast<int>(columns.size()));
  const auto all_counts = comm_.gather(std::span<const int>(counts));
  const auto all_columns = comm_.gather(std::span<const long long>(columns));
  if (comm_.is_root()) build_serial(all_counts, all_columns);
}

void RootedMatrix::build_serial(const std::vector<int>& counts,
                                const std::vector<long long>& columns) {
  const std::size_t n = counts.size();
  std::vector<std::size_t> first_of(n);  // where a gathered row starts in the stream of values
  std::exclusive_scan(counts.begin(), counts.end(), first_of.begin(), std::size_t{0});
  std::vector<std::size_t> gathered_row(n);
  for (std::size_t g = 0; g < n; ++g) gathered_row[rows_.rows()[g]] = g;

  std::vector<std::size_t> begin(n + 1, 0);
  std::vector<int> entries(columns.size());
  value_place_.resize(columns.size());
  std::size_t at = 0;
  for (std::size_t row = 0; row < n; ++row) {
    const std::size_t g = gathered_row[row];
    std::vector<std::size_t> order(static_cast<std::size_t>(counts[g]));
    std::iota(order.begin(), order.end(), first_of[g]);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return columns[a] < columns[b]; });
    for (std::size_t k : order) {
      entries[at] = static_cast<int>(columns[k]);
      value_place_[k] = at++;
    }
    begin[row + 1] = at;
  }
  serial_ = make_serial_matrix(begin, entries);
  rhs_.emplace(assembly::rows_of(serial_->getRowMap()));
  solution_.emplace(rhs_->rows());
  gathered_values_.resize(columns.size());
}

void RootedMatrix::gather_values() {
  if (comm_.size() == 1) return;
  const auto local = distributed_->getLocalMatrixHost().values;
  value_funnel_.gather({local.data(), local.extent(0)}, gathered_values_);
  if (!comm_.is_root()) return;
  const auto values = serial_->getLocalMatrixHost().values;
  for (std::size_t k = 0; k < value_place_.size(); ++k) {
    values(value_place_[k]) = gathered_values_[k];
  }
}

void RootedMatrix::gather_rhs(const Vector& b) {
  rows_.gather(b.values(), comm_.is_root() ? rhs_->values() : std::span<double>());
}

void RootedMatrix::scatter_solution(Vector& x) {
  rows_.scatter(comm_.is_root() ? solution_->values() : std::span<double>(), x.values());
}

}  // namespace culm::solver
