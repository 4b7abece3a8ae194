#include "matrix_checks.hpp"

#include <culm/math/fetch.hpp>
#include <culm/math/types.hpp>
#include <culm/math/vector_units.hpp>
#include <culm/mechanics/pack.hpp>

#include "sum_of_lanes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace culm::solver {

using assembly::CrsMatrix;
using assembly::Vector;

namespace {

// Products of a row with x, summed, and their sizes, summed.
struct RowSum {
  double products = 0.0;
  double sizes = 0.0;
};

// At least pack_lanes columns that stand side by side.
[[gnu::always_inline]] inline RowSum multiply(const double* row, const double* x,
                                              std::size_t count) {
  Pack products{}, sizes{};
  const auto add = [&](std::size_t k, double first_new) __attribute__((always_inline)) {
    constexpr Pack lane = {0, 1, 2, 3, 4, 5, 6, 7};
    Pack of_row, of_x;
    std::memcpy(&of_row, row + k, sizeof(Pack));
    std::memcpy(&of_x, x + k, sizeof(Pack));
    const Pack product = lane >= first_new ? of_row * of_x : Pack{};
    products += product;
    sizes += product < 0.0 ? -product : product;
  };
  std::size_t k = 0;
  for (; k + pack_lanes <= count; k += pack_lanes) add(k, 0.0);
  // the first lanes of the last ones have been added before
  if (k < count) add(count - pack_lanes, static_cast<double>(k + pack_lanes - count));
  return {sum_of_lanes(products), sum_of_lanes(sizes)};
}

// Columns in any order; those of nodes stand side by side.
[[gnu::always_inline]] inline RowSum multiply(const double* row, const int* columns,
                                              const double* x, std::size_t count) {
  using Four = double __attribute__((vector_size(4 * sizeof(double))));
  using Two = double __attribute__((vector_size(2 * sizeof(double))));
  constexpr std::size_t node = 6;
  Four products{}, sizes{};
  Two more_products{}, more_sizes{};
  RowSum sum;
  for (std::size_t k = 0; k < count;) {
    if (k + node <= count && columns[k + node - 1] - columns[k] == node - 1) {
      Four of_row, of_x;
      Two more_of_row, more_of_x;
      std::memcpy(&of_row, row + k, sizeof(Four));
      std::memcpy(&more_of_row, row + k + 4, sizeof(Two));
      std::memcpy(&of_x, x + columns[k], sizeof(Four));
      std::memcpy(&more_of_x, x + columns[k] + 4, sizeof(Two));
      const Four product = of_row * of_x;
      const Two more = more_of_row * more_of_x;
      products += product;
      more_products += more;
      sizes += product < 0.0 ? -product : product;
      more_sizes += more < 0.0 ? -more : more;
      k += node;
    } else {
      const double product = row[k] * x[columns[k]];
      sum.products += product;
      sum.sizes += std::abs(product);
      ++k;
    }
  }
  more_products += __builtin_shufflevector(products, products, 0, 1) +
                   __builtin_shufflevector(products, products, 2, 3);
  more_sizes +=
      __builtin_shufflevector(sizes, sizes, 0, 1) + __builtin_shufflevector(sizes, sizes, 2, 3);
  sum.products += more_products[0] + more_products[1];
  sum.sizes += more_sizes[0] + more_sizes[1];
  return sum;
}

// Columns of which others own some; there are few such rows.
RowSum multiply(const double* row, const int* columns, const assembly::ColumnValues& x,
                std::size_t count) {
  RowSum sum;
  for (std::size_t k = 0; k < count; ++k) {
    const double product = row[k] * x[columns[k]];
    sum.products += product;
    sum.sizes += std::abs(product);
  }
  return sum;
}

// Columns are in order, and in chains mostly side by side.
CULM_FOR_EACH_VECTOR_UNIT Residual residual_of(const std::size_t* row_begin, const int* columns,
                                               const int* first_column, const double* values,
                                               const assembly::ColumnValues& x,
                                               std::span<const double> b, std::span<double> r) {
  Residual result;
  const std::size_t num_own = x.own.size();
  const auto product_of = [&](std::size_t first, std::size_t count, int column)
      __attribute__((always_inline)) {
    const double* const row = values + first;
    // the column tells it, those of all entries would have to be read
    if (column >= 0 && count >= pack_lanes && index(column) + count <= num_own) {
      return multiply(row, x.own.data() + column, count);
    }
    const int* const of_row = columns + first;
    if (count > 0 && index(of_row[count - 1]) >= num_own) return multiply(row, of_row, x, count);
    return multiply(row, of_row, x.own.data(), count);
  };
  for (std::size_t row = 0; row < b.size(); ++row) {
    const std::size_t first = row_begin[row];
    const std::size_t count = row_begin[row + 1] - first;
    const int column = first_column[row];
    fetch(values + first + numbers_ahead, count * sizeof(double));
    const RowSum sum = product_of(first, count, column);
    const double rest = b[row] - sum.products;
    if (!std::isfinite(rest)) return {HUGE_VAL, 1.0};
    if (!r.empty()) r[row] = rest;
    result.largest = std::max(result.largest, std::abs(rest));
    result.size = std::max(result.size, std::abs(b[row]) + sum.sizes);
  }
  return result;
}

}  // namespace

Residual residual(const CrsMatrix& A, std::span<const int> first_column,
                  const assembly::ColumnValues& x, std::span<const double> b, std::span<double> r) {
  const auto matrix = A.getLocalMatrixHost();
  return residual_of(matrix.graph.row_map.data(), matrix.graph.entries.data(), first_column.data(),
                     matrix.values.data(), x, b, r);
}

std::vector<int> first_columns(const CrsMatrix& A) {
  const auto graph = A.getLocalMatrixHost().graph;
  return assembly::first_columns({graph.row_map.data(), graph.row_map.extent(0)},
                                 {graph.entries.data(), graph.entries.extent(0)});
}

double largest_entry(const CrsMatrix& A) {
  const auto values = A.getLocalMatrixHost().values;
  double largest = 0.0;
  for (std::size_t k = 0; k < values.extent(0); ++k) {
    const double size = std::abs(values(k));
    if (!std::isfinite(size)) return HUGE_VAL;
    largest = std::max(largest, size);
  }
  return largest;
}

std::uint64_t fingerprint(const CrsMatrix& A) {
  const auto add = [](std::uint64_t sum, std::uint64_t bits) {
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio, odd
    return (std::rotl(sum, 23) ^ bits) * golden;
  };
  const auto values = A.getLocalMatrixHost().values;
  std::array<std::uint64_t, 4> sums{};  // side by side, which is faster
  for (std::size_t k = 0; k < values.extent(0); ++k) {
    std::uint64_t& sum = sums[k % sums.size()];
    sum = add(sum, std::bit_cast<std::uint64_t>(values(k)));
  }
  std::uint64_t all = values.extent(0);
  for (const std::uint64_t sum : sums) all = add(all, sum);
  return all;
}

Teuchos::RCP<CrsMatrix> shifted_copy(const CrsMatrix& A, double shift) {
  const auto copy = Teuchos::rcp(new CrsMatrix(A, Teuchos::Copy));
  const auto matrix = copy->getLocalMatrixHost();
  for (int row = 0; row < matrix.numRows(); ++row) {
    const int diagonal = A.getColMap()->getLocalElement(A.getRowMap()->getGlobalElement(row));
    const auto at = static_cast<std::size_t>(row);
    for (auto k = matrix.graph.row_map(at); k < matrix.graph.row_map(at + 1); ++k) {
      if (matrix.graph.entries(k) == diagonal) matrix.values(k) += shift;
    }
  }
  return copy;
}

double inverse_iteration(const CrsMatrix& A, const Solve& solve, Vector& v) {
  Vector b(v.rows());
  const auto start = b.values();
  const auto rows = static_cast<long long>(b.rows().total());
  double seed = 0.5;
  for (long long row = 0; row < rows; ++row) {
    seed = std::fmod(997.0 * seed + 0.1234567, 1.0);
    if (const auto here = b.rows().local(row)) start[*here] = seed - 0.5;
  }
  for (int i = 0; i < 4; ++i) {
    solve(b, v);
    v.scale(1.0 / std::max(v.largest(), 1e-300));
    b = v;
  }
  A.apply(tpetra(v), tpetra(b));
  return b.largest();
}

}  // namespace culm::solver
