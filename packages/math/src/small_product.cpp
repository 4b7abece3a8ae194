#include <culm/math/row.hpp>
#include <culm/math/small_product.hpp>
#include <culm/math/vector_units.hpp>

namespace culm {

CULM_FOR_EACH_VECTOR_UNIT void add_product(const double* A, const double* B, double* C, int rows,
                                           int inner, int columns) {
  add_all_columns(1.0, A, B, columns, C, columns, rows, inner, columns);
}

}  // namespace culm
