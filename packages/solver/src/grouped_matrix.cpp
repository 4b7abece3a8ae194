#include "grouped_matrix.hpp"

#include <culm/math/types.hpp>

#include <utility>

namespace culm::solver {
namespace {

RowGroups layout_of(const assembly::CrsMatrix& matrix, std::vector<int> first_row) {
  const auto local = matrix.getLocalMatrixHost();
  std::vector<std::size_t> first_column{0};
  std::vector<int> columns;
  for (std::size_t g = 0; g + 1 < first_row.size(); ++g) {
    const std::size_t row = index(first_row[g]);
    if (first_row[g + 1] > first_row[g]) {
      for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
        columns.push_back(local.graph.entries(k));
      }
    }
    first_column.push_back(columns.size());
  }
  columns.shrink_to_fit();
  return {std::move(first_row), std::move(first_column), std::move(columns)};
}

}  // namespace

GroupedMatrix::GroupedMatrix(const assembly::CrsMatrix& matrix, std::vector<int> first_row)
    : layout_(std::make_shared<RowGroups>(layout_of(matrix, std::move(first_row)))),
      borrowed_values_(matrix.getLocalMatrixHost().values.data()) {}

GroupedMatrix::GroupedMatrix(RowGroups layout, std::vector<double> values)
    : layout_(std::make_shared<RowGroups>(std::move(layout))), own_values_(std::move(values)) {}

std::span<const double> GroupedMatrix::all_values() const {
  const double* first = borrowed_values_ != nullptr ? borrowed_values_ : own_values_.data();
  return {first, layout_->first_value(groups())};
}

void GroupedMatrix::multiply(std::span<const double> x, std::span<double> y) const {
  layout_->multiply(all_values().data(), x, y);
}

void GroupedMatrix::add_product(std::span<const double> x, std::span<double> y) const {
  layout_->add_product(all_values().data(), x, y);
}

void GroupedMatrix::add_transposed(std::span<const double> y, std::span<double> x) const {
  layout_->add_transposed(all_values().data(), y, x);
}

RoundedMatrix::RoundedMatrix(RowGroups layout, std::vector<float> values)
    : layout_(std::make_shared<RowGroups>(std::move(layout))), values_(std::move(values)) {}

void RoundedMatrix::copy(const GroupedMatrix& matrix) {
  layout_ = matrix.layout();
  const auto values = matrix.all_values();
  values_.assign(values.begin(), values.end());
}

void RoundedMatrix::subtract_product(std::span<const double> x, std::span<const double> b,
                                     std::span<double> y) const {
  layout_->subtract_product(values_.data(), x, b, y);
}

void RoundedMatrix::add_projection(std::span<const double> x, std::span<double> y) const {
  layout_->add_projection(values_.data(), x, y);
}

}  // namespace culm::solver
