#include <culm/math/row.hpp>
#include <culm/math/small_product.hpp>
#include <culm/math/vector_units.hpp>

namespace culm {
namespace {

// For so many columns, the sums of which stay in registers.
template <int columns>
[[gnu::always_inline]] inline void add_columns(const double* A, const double* B, double* C,
                                               int rows, int inner, int stride) {
  for (int i = 0; i < rows; ++i) {
    Row<columns> sum, row;
    sum.load(C + i * stride);
    for (int k = 0; k < inner; ++k) {
      row.load(B + k * stride);
      sum.add(A[i * inner + k], row);
    }
    sum.store(C + i * stride);
  }
}

}  // namespace

CULM_FOR_EACH_VECTOR_UNIT void add_product(const double* A, const double* B, double* C, int rows,
                                           int inner, int columns) {
  int done = 0;
  const auto add = [&](auto some) __attribute__((always_inline)) {
    for (; columns - done >= some; done += some) {
      add_columns<some>(A, B + done, C + done, rows, inner, columns);
    }
  };
  add(std::integral_constant<int, 24>());
  add(std::integral_constant<int, 12>());
  add(std::integral_constant<int, 6>());
  add(std::integral_constant<int, 4>());
  add(std::integral_constant<int, 2>());
  add(std::integral_constant<int, 1>());
}

}  // namespace culm
