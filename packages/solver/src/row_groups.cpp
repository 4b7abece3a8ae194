#include "row_groups.hpp"

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
using Run = RowGroups::Run;

[[gnu::always_inline]] inline void load(Pack& pack, const double* numbers) {
  std::memcpy(&pack, numbers, sizeof(Pack));
}

[[gnu::always_inline]] inline void load(Pack& pack, const float* numbers) {
  SinglePack single;
  std::memcpy(&single, numbers, sizeof(SinglePack));
  pack = __builtin_convertvector(single, Pack);
}

[[gnu::always_inline]] inline void gather(std::span<const Run> runs, const double* x,
                                          double* gathered) {
  for (const Run& run : runs) {
    for (int k = 0; k < run.count; ++k) gathered[k] = x[run.first + k];
    gathered += run.count;
  }
}

[[gnu::always_inline]] inline void scatter(std::span<const Run> runs, const double* sums,
                                           double* x) {
  for (const Run& run : runs) {
    for (int k = 0; k < run.count; ++k) x[run.first + k] += sums[k];
    sums += run.count;
  }
}

// Passes A x on, row by row: where several rows share what is read of x, memory is read in as many
// places, and that takes half as long again.
template <class Number, class Take>
[[gnu::always_inline]] inline void multiply_rows(const Number* row, int height, const double* x,
                                                 std::size_t width, const Take& take) {
  const std::size_t in_packs = width / pack_lanes * pack_lanes;
  const std::size_t last = width - std::min<std::size_t>(width, pack_lanes);
  constexpr Pack lane = {0, 1, 2, 3, 4, 5, 6, 7};
  Pack of_rest = {};  // without the lanes that have been added before
  if (in_packs > 0) {
    load(of_rest, x + last);
    of_rest = lane >= static_cast<double>(in_packs - last) ? of_rest : Pack{};
  }
  for (int i = 0; i < height; ++i, row += width) {
    fetch(row + numbers_ahead * sizeof(double) / sizeof(Number), width * sizeof(Number));
    if (in_packs == 0) {
      double sum = 0.0;
      for (std::size_t k = 0; k < width; ++k) sum += static_cast<double>(row[k]) * x[k];
      take(i, sum);
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
    take(i, sum_of_lanes(sums));
  }
}

// x += A^T y.
template <class Number>
[[gnu::always_inline]] inline void add_rows(const Number* row, int height, const double* y,
                                            std::size_t width, double* x) {
  for (; height > 0; --height, ++y, row += width) {
    fetch(row + numbers_ahead * sizeof(double) / sizeof(Number), width * sizeof(Number));
    for (std::size_t k = 0; k < width; ++k) x[k] += static_cast<double>(row[k]) * *y;
  }
}

CULM_FOR_EACH_VECTOR_UNIT void multiply_group(const double* rows, int height,
                                              std::span<const Run> runs, std::size_t width,
                                              const double* x, double* room, double* y) {
  gather(runs, x, room);
  multiply_rows(rows, height, room, width, [y](int i, double sum) { y[i] = sum; });
}

CULM_FOR_EACH_VECTOR_UNIT void add_group(const double* rows, int height, std::span<const Run> runs,
                                         std::size_t width, const double* x, double* room,
                                         double* y) {
  gather(runs, x, room);
  multiply_rows(rows, height, room, width, [y](int i, double sum) { y[i] += sum; });
}

CULM_FOR_EACH_VECTOR_UNIT void subtract_group(const float* rows, int height,
                                              std::span<const Run> runs, std::size_t width,
                                              const double* x, double* room, const double* b,
                                              double* y) {
  gather(runs, x, room);
  multiply_rows(rows, height, room, width, [b, y](int i, double sum) { y[i] = b[i] - sum; });
}

CULM_FOR_EACH_VECTOR_UNIT void add_group_transposed(const double* rows, int height,
                                                    std::span<const Run> runs, std::size_t width,
                                                    const double* y, double* room, double* x) {
  for (std::size_t k = 0; k < width; ++k) room[k] = 0.0;
  add_rows(rows, height, y, width, room);
  scatter(runs, room, x);
}

CULM_FOR_EACH_VECTOR_UNIT void project_group(const float* rows, int height,
                                             std::span<const Run> runs, std::size_t width,
                                             const double* x, double* room, double* shares,
                                             double* y) {
  gather(runs, x, room);
  multiply_rows(rows, height, room, width, [shares](int i, double sum) { shares[i] = sum; });
  for (std::size_t k = 0; k < width; ++k) room[k] = 0.0;
  add_rows(rows, height, shares, width, room);
  scatter(runs, room, y);
}

}  // namespace

RowGroups::RowGroups(std::vector<int> first_row, std::vector<std::size_t> first_column,
                     std::vector<int> columns)
    : first_row_(std::move(first_row)),
      first_column_(std::move(first_column)),
      columns_(std::move(columns)) {
  for (int g = 0; g < groups(); ++g) {
    const std::span<const int> list = this->columns(g);
    for (std::size_t k = 0; k < list.size(); ++k) {
      const bool goes_on = k > 0 && list[k] == list[k - 1] + 1;
      if (!goes_on) runs_.push_back({list[k], 0});
      ++runs_.back().count;
    }
    first_run_.push_back(runs_.size());
    first_value_.push_back(first_value_.back() + index(height(g)) * list.size());
    widest_ = std::max(widest_, list.size());
    highest_ = std::max(highest_, index(height(g)));
  }
  runs_.shrink_to_fit();
}

int RowGroups::height(int group) const {
  return first_row_[index(group) + 1] - first_row_[index(group)];
}

std::span<const int> RowGroups::columns(int group) const {
  const std::size_t first = first_column_[index(group)];
  return {columns_.data() + first, first_column_[index(group) + 1] - first};
}

std::span<const Run> RowGroups::runs(int group) const {
  const std::size_t first = first_run_[index(group)];
  return {runs_.data() + first, first_run_[index(group) + 1] - first};
}

void RowGroups::multiply(const double* values, std::span<const double> x,
                         std::span<double> y) const {
  std::vector<double> room(widest_);
  for (int g = 0; g < groups(); ++g) {
    multiply_group(values + first_value(g), height(g), runs(g), columns(g).size(), x.data(),
                   room.data(), y.data() + first_row_[index(g)]);
  }
}

void RowGroups::add_product(const double* values, std::span<const double> x,
                            std::span<double> y) const {
  std::vector<double> room(widest_);
  for (int g = 0; g < groups(); ++g) {
    add_group(values + first_value(g), height(g), runs(g), columns(g).size(), x.data(), room.data(),
              y.data() + first_row_[index(g)]);
  }
}

void RowGroups::subtract_product(const float* values, std::span<const double> x,
                                 std::span<const double> b, std::span<double> y) const {
  std::vector<double> room(widest_);
  for (int g = 0; g < groups(); ++g) {
    const std::size_t first = index(first_row_[index(g)]);
    subtract_group(values + first_value(g), height(g), runs(g), columns(g).size(), x.data(),
                   room.data(), b.data() + first, y.data() + first);
  }
}

void RowGroups::add_transposed(const double* values, std::span<const double> y,
                               std::span<double> x) const {
  std::vector<double> room(widest_);
  for (int g = 0; g < groups(); ++g) {
    add_group_transposed(values + first_value(g), height(g), runs(g), columns(g).size(),
                         y.data() + first_row_[index(g)], room.data(), x.data());
  }
}

void RowGroups::add_projection(const float* values, std::span<const double> x,
                               std::span<double> y) const {
  std::vector<double> room(widest_), shares(highest_);
  for (int g = 0; g < groups(); ++g) {
    project_group(values + first_value(g), height(g), runs(g), columns(g).size(), x.data(),
                  room.data(), shares.data(), y.data());
  }
}

}  // namespace culm::solver
