/// Products and factors of small dense blocks, stored by rows. A size is an int, or a Fixed one,
/// with which the compiler unrolls the loops.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace culm::solver {

template <int size>
using Fixed = std::integral_constant<int, size>;

/// The diagonal is a pivot as long as it is so large beside the entries below, because eliminating
/// with the diagonal does not depend on how rows are scaled.
constexpr double preferred_pivot = 1e-3;

/// What rounding may leave of a number where many others have been subtracted.
constexpr double rounding = 512.0 * std::numeric_limits<double>::epsilon();

/// D = P^T L U in place, with the reciprocals of the pivots on the diagonal.
/// @param before     largest size of each diagonal entry so far: a pivot that is smaller by all
///                   digits is nothing but rounding
/// @param exchanged  of each row, the one it was exchanged with
/// @return false if a pivot is too small or not a number
template <class Size>
bool factor_block(double* D, int stride, Size size, const double* before, int* exchanged) {
  for (int c = 0; c < size; ++c) {
    double* row_c = D + c * stride;
    int best = c;
    double largest = std::abs(row_c[c]) / preferred_pivot;
    for (int r = c + 1; r < size; ++r) {
      const double entry = std::abs(D[r * stride + c]);
      if (entry <= largest) continue;
      // the first that beats the diagonal by far; then the largest of all
      best = r;
      largest = entry;
    }
    if (best != c) std::swap_ranges(row_c, row_c + size, D + best * stride);
    exchanged[c] = best;
    if (!(std::abs(row_c[c]) > rounding * before[c])) return false;
    row_c[c] = 1.0 / row_c[c];
    for (int r = c + 1; r < size; ++r) {
      double* row_r = D + r * stride;
      row_r[c] *= row_c[c];
      for (int k = c + 1; k < size; ++k) row_r[k] -= row_r[c] * row_c[k];
    }
  }
  return true;
}

/// X = D^-1 X with the factors of D. @param stride of D @param columns of X
template <class Size, class Columns>
void solve_block(const double* D, int stride, Size size, const int* exchanged, double* X,
                 int stride_X, Columns columns) {
  for (int c = 0; c < size; ++c) {
    if (exchanged[c] == c) continue;
    std::swap_ranges(X + c * stride_X, X + c * stride_X + columns, X + exchanged[c] * stride_X);
  }
  for (int r = 1; r < size; ++r) {
    for (int c = 0; c < r; ++c) {
      const double factor = D[r * stride + c];
      for (int k = 0; k < columns; ++k) X[r * stride_X + k] -= factor * X[c * stride_X + k];
    }
  }
  for (int r = size - 1; r >= 0; --r) {
    for (int c = r + 1; c < size; ++c) {
      const double factor = D[r * stride + c];
      for (int k = 0; k < columns; ++k) X[r * stride_X + k] -= factor * X[c * stride_X + k];
    }
    const double pivot = D[r * stride + r];  // its reciprocal
    for (int k = 0; k < columns; ++k) X[r * stride_X + k] *= pivot;
  }
}

/// C -= A B. @param inner columns of A
template <class Rows, class Inner, class Columns>
void subtract_product(const double* A, const double* B, int stride_B, double* C, int stride_C,
                      Rows rows, Inner inner, Columns columns) {
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < inner; ++j) {
      const double factor = A[i * inner + j];
      for (int k = 0; k < columns; ++k) C[i * stride_C + k] -= factor * B[j * stride_B + k];
    }
  }
}

}  // namespace culm::solver
