/// Symmetric matrices in half the memory.
#pragma once

#include <culm/math/types.hpp>

#include <algorithm>
#include <array>

namespace culm {

/// The upper triangle of a symmetric matrix of M rows, row by row: for what there are many of.
template <int M>
class Symmetric {
 public:
  /// Takes the upper triangle of a matrix.
  explicit Symmetric(const RowMat<M, M>& full) {
    auto to = upper_.begin();
    for (int i = 0; i < M; ++i) to = std::copy_n(full.data() + M * i + i, M - i, to);
  }

  RowMat<M, M> full() const noexcept {
    RowMat<M, M> result;
    const double* from = upper_.data();
    for (int i = 0; i < M; ++i) {
      std::copy_n(from, M - i, result.data() + M * i + i);
      for (int j = i + 1; j < M; ++j) result(j, i) = from[j - i];
      from += M - i;
    }
    return result;
  }

 private:
  std::array<double, M*(M + 1) / 2> upper_;
};

}  // namespace culm
