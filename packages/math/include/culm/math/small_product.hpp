/// Products of small dense matrices of fixed size, row by row.
#pragma once

#include <culm/math/types.hpp>

namespace culm {

/// C += A B for row-major C, shape (R, K) x (K, C). Eigen hands products of this size to its
/// blocked kernel for large matrices, which costs several times as much. Each row of C is summed in
/// registers, in runs of columns short enough to fit.
template <int R, int K, int C>
void multiply_add(const RowMat<R, K>& A, const RowMat<K, C>& B, RowMat<R, C>& product) {
  constexpr int run = C % 24 == 0 ? 24 : C % 14 == 0 ? 14 : C % 12 == 0 ? 12 : C % 10 == 0 ? 10 : C;
  static_assert(run <= 24, "a run of columns has to fit into registers");
  for (int first = 0; first < C; first += run) {
    for (int i = 0; i < R; ++i) {
      double sum[run] = {};
      for (int k = 0; k < K; ++k) {
        const double a = A.data()[i * K + k];
        const double* row = B.data() + k * C + first;
        for (int j = 0; j < run; ++j) sum[j] += a * row[j];
      }
      double* out = product.data() + i * C + first;
      for (int j = 0; j < run; ++j) out[j] += sum[j];
    }
  }
}

/// C = A B, as multiply_add.
template <int R, int K, int C>
void multiply(const RowMat<R, K>& A, const RowMat<K, C>& B, RowMat<R, C>& product) {
  product.setZero();
  multiply_add(A, B, product);
}

}  // namespace culm
