/// Products and factors of small dense blocks, stored by rows. A size is an int, or a Fixed one,
/// with which the compiler unrolls the loops.
#pragma once

#include <culm/math/row.hpp>
#include <culm/mechanics/pack.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>

namespace culm::solver {

template <int size>
using Fixed = std::integral_constant<int, size>;

/// A known count is moved in vectors.
template <int count>
[[gnu::always_inline]] inline void copy_numbers(const double* from, Fixed<count>, double* to) {
  Row<count> numbers;
  numbers.load(from);
  numbers.store(to);
}
[[gnu::always_inline]] inline void copy_numbers(const double* from, int count, double* to) {
  std::copy_n(from, count, to);
}

/// The diagonal is a pivot as long as it is so large beside the entries below, because eliminating
/// with the diagonal does not depend on how rows are scaled.
constexpr double preferred_pivot = 1e-3;

/// One over the largest entry of each row of a block; 1 where there is none.
template <class Size>
void find_row_weights(const double* D, int stride, Size size, double* weight) {
  for (int r = 0; r < size; ++r) {
    double largest = 0.0;
    for (int k = 0; k < size; ++k) largest = std::max(largest, std::abs(D[r * stride + k]));
    weight[r] = largest > 0.0 ? 1.0 / largest : 1.0;
  }
}

/// The row with the pivot of a column of a block, at or below the diagonal.
/// @param weight of each row, by which its entries are compared
template <class Size, class Weight>
int find_pivot(const double* D, int stride, Size size, int column, const Weight& weight) {
  const auto size_of = [&](int row) { return weight(row) * std::abs(D[row * stride + column]); };
  double largest = size_of(column);
  for (int r = column + 1; r < size; ++r) largest = std::max(largest, size_of(r));
  if (!(size_of(column) < preferred_pivot * largest)) return column;
  int row = column + 1;
  while (size_of(row) < largest) ++row;
  return row;
}

/// [D U] with D = P^T L U' in place, the reciprocals of the pivots on the diagonal, and U replaced
/// by D^-1 U.
/// @param columns    of U, right of D
/// @param before     largest size of each diagonal entry so far
/// @param least      of which each pivot must exceed so much
/// @param exchanged  of each row, the one it was exchanged with
/// @param weight     room for a number of each row. Rows of multipliers have another scale than
///                   those of nodes, so pivots are compared with the largest entries of their rows
/// @return false if a pivot is too small or not a number
inline bool factor_long_rows(double* D, int size, int columns, const double* before, double least,
                             int* exchanged, double* weight) {
  const int stride = size + columns;
  find_row_weights(D, stride, size, weight);
  for (int c = 0; c < size; ++c) {
    double* row_c = D + c * stride;
    const int best = find_pivot(D, stride, size, c, [&](int row) { return weight[row]; });
    if (best != c) {
      std::swap_ranges(row_c, row_c + stride, D + best * stride);
      std::swap(weight[c], weight[best]);
    }
    exchanged[c] = best;
    if (!(std::abs(row_c[c]) > least * before[c])) return false;
    row_c[c] = 1.0 / row_c[c];
    for (int r = c + 1; r < size; ++r) {
      double* row_r = D + r * stride;
      const double factor = row_r[c] *= row_c[c];
      for (int k = c + 1; k < size; ++k) row_r[k] -= factor * row_c[k];
    }
  }
  double* U = D + size;
  for (int r = 1; r < size; ++r) {
    for (int c = 0; c < r; ++c) {
      const double factor = D[r * stride + c];
      for (int k = 0; k < columns; ++k) U[r * stride + k] -= factor * U[c * stride + k];
    }
  }
  for (int r = size - 1; r >= 0; --r) {
    for (int c = r + 1; c < size; ++c) {
      const double factor = D[r * stride + c];
      for (int k = 0; k < columns; ++k) U[r * stride + k] -= factor * U[c * stride + k];
    }
    const double pivot = D[r * stride + r];  // its reciprocal
    for (int k = 0; k < columns; ++k) U[r * stride + k] *= pivot;
  }
  return true;
}

/// No more numbers than these are read behind a panel, with the last of its rows.
constexpr int numbers_behind = pack_lanes;

/// The same with rows of so many vectors. @param room for size of them
template <int vectors>
[[gnu::always_inline]] inline bool factor_rows(double* D, int size, int columns,
                                               const double* before, double least, int* exchanged,
                                               double* weight, Pack* room) {
  const int stride = size + columns;
  const auto row = [&](int r) { return room + r * vectors; };
  // numbers of a row, also as those of its vectors
  const auto numbers = [&](int r) { return reinterpret_cast<double*>(row(r)); };
  for (int r = 0; r < size; ++r) {
    // with what follows the row, which is not looked at
    std::memcpy(row(r), D + r * stride, sizeof(Pack) * vectors);
  }
  // whole rows are subtracted, so that what stands left of the pivots is not kept there but in D
  const auto subtract = [&](double factor, int from, int of) {
    for (int k = 0; k < vectors; ++k) row(of)[k] -= factor * row(from)[k];
  };
  find_row_weights(D, stride, size, weight);
  for (int c = 0; c < size; ++c) {
    const int best =
        find_pivot(numbers(0), vectors * pack_lanes, size, c, [&](int r) { return weight[r]; });
    if (best != c) {
      std::swap_ranges(row(c), row(c) + vectors, row(best));
      std::swap_ranges(D + c * stride, D + c * stride + c, D + best * stride);
      std::swap(weight[c], weight[best]);
    }
    exchanged[c] = best;
    const double pivot = numbers(c)[c];
    if (!(std::abs(pivot) > least * before[c])) return false;
    D[c * stride + c] = 1.0 / pivot;
    std::copy(numbers(c) + c + 1, numbers(c) + size, D + c * stride + c + 1);
    for (int r = c + 1; r < size; ++r) {
      const double factor = D[r * stride + c] = numbers(r)[c] * D[c * stride + c];
      subtract(factor, c, r);
    }
  }
  // of rows that are longer than a vector, the first one may hold nothing of U
  const auto substitute = [&](auto first) __attribute__((always_inline)) {
    for (int r = size - 1; r >= 0; --r) {
      Pack solved[vectors];
      for (int k = first; k < vectors; ++k) solved[k] = row(r)[k];
      for (int c = r + 1; c < size; ++c) {
        const double factor = D[r * stride + c];
        for (int k = first; k < vectors; ++k) solved[k] -= factor * row(c)[k];
      }
      for (int k = first; k < vectors; ++k) row(r)[k] = solved[k] * D[r * stride + r];
      std::copy_n(numbers(r) + size, columns, D + r * stride + size);
    }
  };
  if (vectors > 1 && size >= pack_lanes) {
    substitute(Fixed<1>());
  } else {
    substitute(Fixed<0>());
  }
  return true;
}

/// How many vectors a row of so many numbers fills.
constexpr int vectors_of(int numbers) { return (numbers + pack_lanes - 1) / pack_lanes; }

/// The same for rows of any length.
[[gnu::always_inline]] inline bool factor_panel(double* D, int size, int columns,
                                                const double* before, double least, int* exchanged,
                                                double* weight, Pack* room) {
  const auto factor = [&](auto vectors) __attribute__((always_inline)) {
    return factor_rows<vectors>(D, size, columns, before, least, exchanged, weight, room);
  };
  switch (vectors_of(size + columns)) {
    case 1:
      return factor(Fixed<1>());
    case 2:
      return factor(Fixed<2>());
    case 3:
      return factor(Fixed<3>());
    case 4:
      return factor(Fixed<4>());
    default:
      return factor_long_rows(D, size, columns, before, least, exchanged, weight);
  }
}

/// The same where all pivots stay on the diagonal. @param before, least  as above
/// @return false, and nothing is changed, if a row would have to be exchanged or a pivot is too
/// small
template <int size, int columns>
[[gnu::always_inline]] inline bool factor_in_order(double* D, const double* before, double least,
                                                   double* weight) {
  // rows of a node are of one scale
  constexpr bool is_node = size == 6;
  constexpr int stride = size + columns;
  const auto weight_of = [&](int row) { return is_node ? 1.0 : weight[row]; };
  if (!is_node) find_row_weights(D, stride, Fixed<size>(), weight);
  Row<size> d[size];
  Row<columns> u[size];
  double factors[size][size];
  double reciprocal[size];
  for (int r = 0; r < size; ++r) {
    d[r].load(D + r * stride);
    u[r].load(D + r * stride + size);
  }
  bool is_sound = true;
  unrolled<size>([&](auto c) __attribute__((always_inline)) {
    const double pivot = d[c].template get<c>();
    double largest = 0.0;
    unrolled<size - 1 - c>([&](auto below) __attribute__((always_inline)) {
      constexpr int r = c + 1 + below;
      factors[r][c] = d[r].template get<c>();
      largest = std::max(largest, weight_of(r) * std::abs(factors[r][c]));
    });
    const bool stays = !(weight_of(c) * std::abs(pivot) < preferred_pivot * largest);
    is_sound = is_sound && stays && std::abs(pivot) > least * before[c];
    reciprocal[c] = 1.0 / pivot;
    unrolled<size - 1 - c>([&](auto below) __attribute__((always_inline)) {
      constexpr int r = c + 1 + below;
      const double factor = factors[r][c] *= reciprocal[c];
      d[r].subtract(factor, d[c]);
      u[r].subtract(factor, u[c]);
    });
  });
  if (!is_sound) return false;
  unrolled<size>([&](auto reversed) __attribute__((always_inline)) {
    constexpr int r = size - 1 - reversed;
    unrolled<reversed>([&](auto beyond) __attribute__((always_inline)) {
      constexpr int c = r + 1 + beyond;
      u[r].subtract(d[r].template get<c>(), u[c]);
    });
    u[r].scale(reciprocal[r]);
  });
  for (int r = 0; r < size; ++r) {
    d[r].store(D + r * stride);
    u[r].store(D + r * stride + size);
    std::copy_n(factors[r], r, D + r * stride);
    D[r * stride + r] = reciprocal[r];
  }
  return true;
}

/// The same for sizes that are known: first without exchanges, which are rare.
template <int size, int columns>
[[gnu::always_inline]] inline bool factor_panel(double* D, Fixed<size>, Fixed<columns>,
                                                const double* before, double least, int* exchanged,
                                                double* weight, Pack* room) {
  if (!factor_in_order<size, columns>(D, before, least, weight)) {
    return factor_panel(D, size, columns, before, least, exchanged, weight, room);
  }
  std::iota(exchanged, exchanged + size, 0);
  return true;
}

/// Exchanges rows of x as those of D were.
[[gnu::always_inline]] inline void exchange_rows(std::span<const int> exchanged, double* x) {
  for (int c = 0; c < static_cast<int>(exchanged.size()); ++c) {
    const int other = exchanged[static_cast<std::size_t>(c)];
    if (other != c) std::swap(x[c], x[other]);
  }
}

/// x = D^-1 x with the factors of D, where rows of x are exchanged already. @param stride of D
template <class Size>
[[gnu::always_inline]] inline void solve_block(const double* D, int stride, Size size, double* x) {
  for (int r = 1; r < size; ++r) {
    for (int c = 0; c < r; ++c) x[r] -= D[r * stride + c] * x[c];
  }
  // column by column, so that rows wait for one product only
  for (int c = size - 1; c >= 0; --c) {
    x[c] *= D[c * stride + c];  // the reciprocal of the pivot
    for (int r = 0; r < c; ++r) x[r] -= D[r * stride + c] * x[c];
  }
}

/// C -= A B, with rows that fit into registers. @param inner columns of A, rows of B
template <int rows, int inner, int columns>
[[gnu::always_inline]] inline void subtract_product(const double* A, const double* B, int stride_B,
                                                    double* C, int stride_C, Fixed<rows>,
                                                    Fixed<inner>, Fixed<columns>) {
  Row<columns> b[inner];
  for (int j = 0; j < inner; ++j) b[j].load(B + j * stride_B);
  for (int i = 0; i < rows; ++i) {
    Row<columns> c;
    c.load(C + i * stride_C);
    for (int j = 0; j < inner; ++j) c.subtract(A[i * inner + j], b[j]);
    c.store(C + i * stride_C);
  }
}

/// The same for any number of rows and columns.
[[gnu::always_inline]] inline void subtract_product(const double* A, const double* B, int stride_B,
                                                    double* C, int stride_C, int rows, int inner,
                                                    int columns) {
  add_all_columns(-1.0, A, B, stride_B, C, stride_C, rows, inner, columns);
}

/// y -= A x. @param stride of A
template <class Rows, class Columns>
void subtract_product(const double* A, int stride, const double* x, double* y, Rows rows,
                      Columns columns) {
  for (int i = 0; i < rows; ++i) {
    double sum = 0.0;
    for (int k = 0; k < columns; ++k) sum += A[i * stride + k] * x[k];
    y[i] -= sum;
  }
}

}  // namespace culm::solver
