/// Products of small dense matrices, row by row.
#pragma once

#include <culm/math/types.hpp>

namespace culm {

/// C += A B, all by rows, for the vector unit at hand. Eigen hands products of this size to its
/// blocked kernel for large matrices, which costs several times as much.
/// @param inner  columns of A, rows of B
void add_product(const double* A, const double* B, double* C, int rows, int inner, int columns);

/// C += A B
template <int R, int K, int C>
void multiply_add(const RowMat<R, K>& A, const RowMat<K, C>& B, RowMat<R, C>& product) {
  add_product(A.data(), B.data(), product.data(), R, K, C);
}

/// C = A B, as multiply_add.
template <int R, int K, int C>
void multiply(const RowMat<R, K>& A, const RowMat<K, C>& B, RowMat<R, C>& product) {
  product.setZero();
  multiply_add(A, B, product);
}

}  // namespace culm
