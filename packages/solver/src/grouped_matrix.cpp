#include "grouped_matrix.hpp"

#include <culm/math/types.hpp>

#include <Eigen/Core>

#include <utility>

namespace culm::solver {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

GroupedMatrix::GroupedMatrix(const assembly::CrsMatrix& matrix, std::vector<int> first_row)
    : first_row_(std::move(first_row)) {
  const auto local = matrix.getLocalMatrixHost();
  borrowed_values_ = local.values.data();
  for (int g = 0; g < groups(); ++g) {
    const std::size_t row = index(first_row_[index(g)]);
    first_value_.push_back(local.graph.row_map(row));
    if (height(g) > 0) {
      for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
        columns_.push_back(local.graph.entries(k));
      }
    }
    first_column_.push_back(columns_.size());
  }
}

GroupedMatrix::GroupedMatrix(std::vector<int> first_row, std::vector<std::size_t> first_column,
                             std::vector<int> columns, std::vector<double> values)
    : first_row_(std::move(first_row)),
      first_column_(std::move(first_column)),
      columns_(std::move(columns)),
      own_values_(std::move(values)) {
  std::size_t at = 0;
  for (int g = 0; g < groups(); ++g) {
    first_value_.push_back(at);
    at += index(height(g)) * this->columns(g).size();
  }
}

int GroupedMatrix::height(int group) const {
  return first_row_[index(group) + 1] - first_row_[index(group)];
}

std::span<const int> GroupedMatrix::columns(int group) const {
  const std::size_t first = first_column_[index(group)];
  return {columns_.data() + first, first_column_[index(group) + 1] - first};
}

const double* GroupedMatrix::values(int group) const {
  const double* all = borrowed_values_ != nullptr ? borrowed_values_ : own_values_.data();
  return all + first_value_[index(group)];
}

void GroupedMatrix::multiply(std::span<const double> x, std::span<double> y) const {
  Eigen::VectorXd gathered;
  for (int g = 0; g < groups(); ++g) {
    const auto list = columns(g);
    const auto width = static_cast<Eigen::Index>(list.size());
    if (gathered.size() < width) gathered.resize(width);
    for (std::size_t k = 0; k < list.size(); ++k) {
      gathered[static_cast<Eigen::Index>(k)] = x[index(list[k])];
    }
    const Eigen::Map<const RowMajor> block(values(g), height(g), width);
    Eigen::Map<Eigen::VectorXd>(y.data() + first_row_[index(g)], height(g)).noalias() =
        block * gathered.head(width);
  }
}

void GroupedMatrix::add_transposed(std::span<const double> y, std::span<double> x) const {
  Eigen::VectorXd sums;
  for (int g = 0; g < groups(); ++g) {
    const auto list = columns(g);
    const auto width = static_cast<Eigen::Index>(list.size());
    if (sums.size() < width) sums.resize(width);
    const Eigen::Map<const RowMajor> block(values(g), height(g), width);
    sums.head(width).noalias() =
        block.transpose() *
        Eigen::Map<const Eigen::VectorXd>(y.data() + first_row_[index(g)], height(g));
    for (std::size_t k = 0; k < list.size(); ++k) {
      x[index(list[k])] += sums[static_cast<Eigen::Index>(k)];
    }
  }
}

}  // namespace culm::solver
