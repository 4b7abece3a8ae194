/// Power series of rotations by small angles, for numbers of any kind.
#pragma once

#include <array>
#include <cstddef>

namespace culm {

/// Below this sin^2 or square of the angle the series leave out less than rounding.
inline constexpr double small_turn_squared = 0.01;

/// sin t / t by t^2.
inline constexpr std::array sine_series = {1.0, -1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880};
/// (1 - cos t) / t^2 by t^2.
inline constexpr std::array cosine_series = {1.0 / 2, -1.0 / 24, 1.0 / 720, -1.0 / 40320,
                                             1.0 / 3628800};
/// t / sin t by sin^2 t.
inline constexpr std::array arcsine_series = {
    1.0, 1.0 / 6, 3.0 / 40, 15.0 / 336, 105.0 / 3456, 945.0 / 42240, 10395.0 / 599040};

/// sum = the polynomial with these coefficients at x; by reference, as vectors have no convention
/// for results.
template <std::size_t terms, class Number>
[[gnu::always_inline]] inline void find_polynomial(const std::array<double, terms>& coefficients,
                                                   const Number& x, Number& sum) {
  sum = x * coefficients[terms - 1] + coefficients[terms - 2];
  for (std::size_t k = terms - 2; k-- > 0;) sum = coefficients[k] + x * sum;
}

}  // namespace culm
