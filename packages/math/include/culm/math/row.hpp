/// A few numbers that stand side by side, in the vectors of the processor.
#pragma once

#include <cstring>
#include <type_traits>
#include <utility>

namespace culm {

/// Calls f(i) with each i below `size` as a constant, without a loop.
template <int size, class F>
[[gnu::always_inline]] inline void unrolled(const F& f) {
  [&]<int... i>(std::integer_sequence<int, i...>) __attribute__((always_inline)) {
    (f(std::integral_constant<int, i>()), ...);
  }
  (std::make_integer_sequence<int, size>());
}

template <class Vector, int count>
struct RowParts {
  Vector part[count];
};
template <class Vector>
struct RowParts<Vector, 0> {};

/// Vectors of eight numbers, then of four, of two, and one. Everything is inlined, so that it is
/// compiled for the vector unit of the function that works with it.
template <int size>
class Row : RowParts<double __attribute__((vector_size(64))), size / 8>,
            RowParts<double __attribute__((vector_size(32))), size % 8 / 4>,
            RowParts<double __attribute__((vector_size(16))), size % 4 / 2>,
            RowParts<double, size % 2> {
  using Eights = RowParts<double __attribute__((vector_size(64))), size / 8>;
  using Four = RowParts<double __attribute__((vector_size(32))), size % 8 / 4>;
  using Two = RowParts<double __attribute__((vector_size(16))), size % 4 / 2>;
  using One = RowParts<double, size % 2>;
  static constexpr int four_at = size / 8 * 8;
  static constexpr int two_at = size / 4 * 4;

 public:
  [[gnu::always_inline]] void load(const double* from) {
    if constexpr (size / 8 > 0) {
      for (int k = 0; k < size / 8; ++k)
        std::memcpy(&Eights::part[k], from + 8 * k, 8 * sizeof(double));
    }
    if constexpr (size % 8 / 4 > 0) std::memcpy(Four::part, from + four_at, 4 * sizeof(double));
    if constexpr (size % 4 / 2 > 0) std::memcpy(Two::part, from + two_at, 2 * sizeof(double));
    if constexpr (size % 2 > 0) One::part[0] = from[size - 1];
  }

  [[gnu::always_inline]] void store(double* to) const {
    if constexpr (size / 8 > 0) {
      for (int k = 0; k < size / 8; ++k)
        std::memcpy(to + 8 * k, &Eights::part[k], 8 * sizeof(double));
    }
    if constexpr (size % 8 / 4 > 0) std::memcpy(to + four_at, Four::part, 4 * sizeof(double));
    if constexpr (size % 4 / 2 > 0) std::memcpy(to + two_at, Two::part, 2 * sizeof(double));
    if constexpr (size % 2 > 0) to[size - 1] = One::part[0];
  }

  /// this += factor other
  [[gnu::always_inline]] void add(double factor, const Row& other) { subtract(-factor, other); }

  /// this -= factor other
  [[gnu::always_inline]] void subtract(double factor, const Row& other) {
    if constexpr (size / 8 > 0) {
      for (int k = 0; k < size / 8; ++k) Eights::part[k] -= factor * other.Eights::part[k];
    }
    if constexpr (size % 8 / 4 > 0) Four::part[0] -= factor * other.Four::part[0];
    if constexpr (size % 4 / 2 > 0) Two::part[0] -= factor * other.Two::part[0];
    if constexpr (size % 2 > 0) One::part[0] -= factor * other.One::part[0];
  }

  [[gnu::always_inline]] void scale(double factor) {
    if constexpr (size / 8 > 0) {
      for (int k = 0; k < size / 8; ++k) Eights::part[k] *= factor;
    }
    if constexpr (size % 8 / 4 > 0) Four::part[0] *= factor;
    if constexpr (size % 4 / 2 > 0) Two::part[0] *= factor;
    if constexpr (size % 2 > 0) One::part[0] *= factor;
  }

  template <int k>
  [[gnu::always_inline]] double get() const {
    if constexpr (k < four_at) {
      return Eights::part[k / 8][k % 8];
    } else if constexpr (k < two_at) {
      return Four::part[0][k - four_at];
    } else if constexpr (k < size / 2 * 2) {
      return Two::part[0][k - two_at];
    } else {
      return One::part[0];
    }
  }
};

/// C += sign A B for so many columns, whose sums stay in registers, and any number of rows.
/// @param inner  columns of A, rows of B
template <int columns>
[[gnu::always_inline]] inline void add_columns(double sign, const double* A, const double* B,
                                               int stride_B, double* C, int stride_C, int rows,
                                               int inner) {
  for (int i = 0; i < rows; ++i) {
    Row<columns> sum, row;
    sum.load(C + i * stride_C);
    for (int j = 0; j < inner; ++j) {
      row.load(B + j * stride_B);
      sum.add(sign * A[i * inner + j], row);
    }
    sum.store(C + i * stride_C);
  }
}

/// The same for any number of columns.
[[gnu::always_inline]] inline void add_all_columns(double sign, const double* A, const double* B,
                                                   int stride_B, double* C, int stride_C, int rows,
                                                   int inner, int columns) {
  int done = 0;
  const auto add = [&](auto some) __attribute__((always_inline)) {
    for (; columns - done >= some; done += some) {
      add_columns<some>(sign, A, B + done, stride_B, C + done, stride_C, rows, inner);
    }
  };
  add(std::integral_constant<int, 24>());
  add(std::integral_constant<int, 12>());
  add(std::integral_constant<int, 8>());
  add(std::integral_constant<int, 6>());
  add(std::integral_constant<int, 4>());
  add(std::integral_constant<int, 2>());
  add(std::integral_constant<int, 1>());
}

}  // namespace culm
