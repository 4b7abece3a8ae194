#include "grouped_matrix.hpp"

#include <culm/math/fetch.hpp>
#include <culm/math/types.hpp>
#include <culm/math/vector_units.hpp>
#include <culm/mechanics/pack.hpp>

#include "sum_of_lanes.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace culm::solver {
namespace {

using SinglePack = float __attribute__((vector_size(pack_lanes * sizeof(float))));

[[gnu::always_inline]] inline void load(Pack& pack, const double* numbers) {
  std::memcpy(&pack, numbers, sizeof(Pack));
}

[[gnu::always_inline]] inline void load(Pack& pack, const float* numbers) {
  SinglePack single;
  std::memcpy(&single, numbers, sizeof(SinglePack));
  pack = __builtin_convertvector(single, Pack);
}

// y = A x. Row by row: where several share what is read of x, memory is read in as many places, and
// that takes half as long again.
template <class Number>
[[gnu::always_inline]] inline void multiply_rows(const Number* row, int height, const double* x,
                                                 std::size_t width, double* y) {
  const std::size_t in_packs = width / pack_lanes * pack_lanes;
  const std::size_t last = width - std::min<std::size_t>(width, pack_lanes);
  constexpr Pack lane = {0, 1, 2, 3, 4, 5, 6, 7};
  Pack of_rest = {};  // without the lanes that have been added before
  if (in_packs > 0) {
    load(of_rest, x + last);
    of_rest = lane >= static_cast<double>(in_packs - last) ? of_rest : Pack{};
  }
  for (; height > 0; --height, ++y, row += width) {
    fetch(row + numbers_ahead * sizeof(double) / sizeof(Number), width * sizeof(Number));
    if (in_packs == 0) {
      *y = 0.0;
      for (std::size_t k = 0; k < width; ++k) *y += static_cast<double>(row[k]) * x[k];
      continue;
    }
    Pack of_row;
    load(of_row, row + last);
    Pack sums = of_row * of_rest;
    for (std::size_t k = 0; k < in_packs; k += pack_lanes) {
      Pack of_x;
      load(of_x, x + k);
      load(of_row, row + k);
      sums += of_row * of_x;
    }
    *y = sum_of_lanes(sums);
  }
}

CULM_FOR_EACH_VECTOR_UNIT void multiply_group(const double* rows, int height, const double* x,
                                              std::size_t width, double* y) {
  multiply_rows(rows, height, x, width, y);
}

CULM_FOR_EACH_VECTOR_UNIT void multiply_group(const float* rows, int height, const double* x,
                                              std::size_t width, double* y) {
  multiply_rows(rows, height, x, width, y);
}

// x += A^T y.
CULM_FOR_EACH_VECTOR_UNIT void add_group(const double* row, int height, const double* y,
                                         std::size_t width, double* x) {
  for (; height > 0; --height, ++y, row += width) {
    fetch(row + numbers_ahead, width * sizeof(double));
    for (std::size_t k = 0; k < width; ++k) x[k] += row[k] * *y;
  }
}

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
    widest_ = std::max(widest_, this->columns(g).size());
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
    widest_ = std::max(widest_, this->columns(g).size());
  }
}

int GroupedMatrix::height(int group) const {
  return first_row_[index(group) + 1] - first_row_[index(group)];
}

std::span<const int> GroupedMatrix::columns(int group) const {
  const std::size_t first = first_column_[index(group)];
  return {columns_.data() + first, first_column_[index(group) + 1] - first};
}

const double* GroupedMatrix::all_values() const {
  return borrowed_values_ != nullptr ? borrowed_values_ : own_values_.data();
}

const double* GroupedMatrix::values(int group) const {
  return all_values() + first_value_[index(group)];
}

void GroupedMatrix::multiply(std::span<const double> x, std::span<double> y) const {
  multiply_by(all_values(), x, y);
}

void GroupedMatrix::multiply(std::span<const float> rounded, std::span<const double> x,
                             std::span<double> y) const {
  multiply_by(rounded.data(), x, y);
}

template <class Number>
void GroupedMatrix::multiply_by(const Number* all, std::span<const double> x,
                                std::span<double> y) const {
  std::vector<double> gathered(widest_);
  for (int g = 0; g < groups(); ++g) {
    gather(g, x, gathered);
    multiply_group(all + first_value_[index(g)], height(g), gathered.data(), columns(g).size(),
                   y.data() + first_row_[index(g)]);
  }
}

void GroupedMatrix::round(std::vector<float>& rounded) const {
  const std::size_t size = groups() == 0 ? 0
                                         : first_value_.back() + index(height(groups() - 1)) *
                                                                     columns(groups() - 1).size();
  rounded.resize(size);
  std::transform(all_values(), all_values() + size, rounded.begin(),
                 [](double value) { return static_cast<float>(value); });
}

void GroupedMatrix::gather(int group, std::span<const double> x,
                           std::vector<double>& gathered) const {
  const auto list = columns(group);
  for (std::size_t k = 0; k < list.size(); ++k) gathered[k] = x[index(list[k])];
}

void GroupedMatrix::add_projection(std::span<const double> x, std::span<double> y) const {
  std::vector<double> gathered(widest_), sums(widest_), shares;
  for (int g = 0; g < groups(); ++g) {
    const auto list = columns(g);
    gather(g, x, gathered);
    shares.resize(index(height(g)));
    multiply_group(values(g), height(g), gathered.data(), list.size(), shares.data());
    std::fill_n(sums.begin(), list.size(), 0.0);
    add_group(values(g), height(g), shares.data(), list.size(), sums.data());
    for (std::size_t k = 0; k < list.size(); ++k) y[index(list[k])] += sums[k];
  }
}

void GroupedMatrix::add_transposed(std::span<const double> y, std::span<double> x) const {
  std::vector<double> sums(widest_);
  for (int g = 0; g < groups(); ++g) {
    const auto list = columns(g);
    std::fill_n(sums.begin(), list.size(), 0.0);
    add_group(values(g), height(g), y.data() + first_row_[index(g)], list.size(), sums.data());
    for (std::size_t k = 0; k < list.size(); ++k) x[index(list[k])] += sums[k];
  }
}

}  // namespace culm::solver
