#include "grid_level.hpp"

#include "exchange.hpp"

#include <utility>

namespace culm::solver {

using assembly::tpetra;
using assembly::Vector;

namespace {

std::vector<int> sum_up(const std::vector<int>& widths) {
  std::vector<int> first{0};
  for (int width : widths) first.push_back(first.back() + width);
  return first;
}

}  // namespace

GridLevel::GridLevel(Teuchos::RCP<const assembly::CrsMatrix> matrix, const std::vector<int>& widths,
                     NearNullSpace rigid, const parallel::Comm& comm)
    : matrix_(std::move(matrix)),
      rows_(*matrix_, sum_up(widths)),
      rigid_(std::move(rigid)),
      first_column_(rows_.first_row()),
      begin_(count_by_rank(nodes(), comm)) {
  for (int node = 0; node < nodes(); ++node)
    node_of_.resize(node_of_.size() + static_cast<std::size_t>(width(node)), node);
  const auto importer = matrix_->getGraph()->getImporter();
  if (importer.is_null()) return;
  columns_.emplace(assembly::rows_of(matrix_->getColMap()));
  Vector number(assembly::rows_of(matrix_->getRowMap()));
  const auto here = number.values();
  const auto rank = static_cast<std::size_t>(comm.rank());
  for (std::size_t row = 0; row < here.size(); ++row) {
    here[row] = static_cast<double>(begin_[rank] + node_of_[row]);  // exact below 2^53
  }
  tpetra(*columns_).doImport(tpetra(number), *importer, Tpetra::INSERT);
  const auto all = std::as_const(*columns_).values();
  for (std::size_t column = here.size(); column < all.size(); ++column) {
    const auto node = static_cast<long long>(all[column]);
    if (beside_.empty() || beside_.back() != node) {
      beside_.push_back(node);
      first_column_.push_back(first_column_.back());
    }
    ++first_column_.back();
    node_of_.push_back(all_nodes() - 1);
  }
}

std::vector<bool> GridLevel::share(const std::vector<bool>& marks) const {
  std::vector<bool> all = marks;
  const auto importer = matrix_->getGraph()->getImporter();
  if (importer.is_null()) return all;
  Vector mine(assembly::rows_of(matrix_->getRowMap()));
  for (std::size_t row = 0; row < mine.values().size(); ++row) {
    mine.values()[row] = marks[static_cast<std::size_t>(node_of_[row])] ? 1.0 : 0.0;
  }
  Vector columns(assembly::rows_of(matrix_->getColMap()));
  tpetra(columns).doImport(tpetra(mine), *importer, Tpetra::INSERT);
  for (int node = nodes(); node < all_nodes(); ++node) {
    all.push_back(columns.values()[static_cast<std::size_t>(first_column(node))] != 0.0);
  }
  return all;
}

std::span<const double> GridLevel::of_all_columns(const Vector& x) const {
  const auto importer = matrix_->getGraph()->getImporter();
  if (importer.is_null()) return x.values();
  tpetra(*columns_).doImport(tpetra(x), *importer, Tpetra::INSERT);
  return std::as_const(*columns_).values();
}

// By nodes, which have one list of columns for all their rows: Tpetra reads a column for each
// value.
void GridLevel::multiply(const Vector& x, Vector& y) const {
  rows_.multiply(of_all_columns(x), y.values());
}

void GridLevel::subtract_product(const RoundedMatrix& rounded, const Vector& x, const Vector& b,
                                 Vector& y) const {
  rounded.subtract_product(of_all_columns(x), b.values(), y.values());
}

}  // namespace culm::solver
