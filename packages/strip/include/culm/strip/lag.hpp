/// The lag of circulation behind the downwash.
#pragma once

#include <array>
#include <cmath>

namespace culm::strip {

/// The step response of lift, phi(s) = 1 - sum_i A_i exp(-b_i s) with s = V t / (chord / 2).
struct Lag {
  static constexpr int max_states = 2;
  int states = 0;
  std::array<double, max_states> amplitude{};  ///< A_i [-]
  std::array<double, max_states> rate{};       ///< b_i [-]

  /// Jones' approximation of Wagner's function, which goes with apparent mass.
  static constexpr Lag jones() { return {2, {0.165, 0.335}, {0.0455, 0.3}}; }
  /// Constants of airfoil files, whose impulsive part stands in place of apparent mass.
  static constexpr Lag airfoil() { return {2, {0.3, 0.7}, {0.14, 0.53}}; }
};

/// The end of a step h of T x' + x = u from x, where u is what it is in the middle of the step on
/// the whole of it: unconditionally stable, second order.
template <class Number>
Number lag_step(double x, const Number& u, const Number& share) {
  return x + (u - x) * share;
}

/// The share 1 - exp(-h / T) of the way that such a step goes.
template <class Number>
Number lag_share(const Number& step_over_time) {
  using std::exp;
  return 1.0 - exp(-step_over_time);
}

}  // namespace culm::strip
