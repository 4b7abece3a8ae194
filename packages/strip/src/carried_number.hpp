/// Numbers that may carry derivatives, and what the forces of a section do with them.
#pragma once

#include <culm/math/types.hpp>
#include <culm/strip/lag.hpp>

#include <unsupported/Eigen/AutoDiff>

#include <cmath>

namespace culm::strip {

/// A number with its derivatives by place, chord and normal of a section at the end of a step.
using Dual = Eigen::AutoDiffScalar<Vec<9>>;

inline double value_of(double number) { return number; }
inline double value_of(const Dual& number) { return number.value(); }

/// A function of a number of which value and slope are known.
inline double chain(double, double value, double) { return value; }
inline Dual chain(const Dual& x, double value, double slope) {
  return {value, Vec<9>(slope * x.derivatives())};
}

/// The angle of a vector; Eigen's own for such numbers takes memory from the heap.
inline double angle_of(double y, double x) { return std::atan2(y, x); }
inline Dual angle_of(const Dual& y, const Dual& x) {
  const double square = x.value() * x.value() + y.value() * y.value();
  return {std::atan2(y.value(), x.value()),
          Vec<9>((x.value() * y.derivatives() - y.value() * x.derivatives()) / square)};
}

/// What follows a target with a delay, in the middle of the step; in statics the target.
/// @param delay  its time [s]
/// @param follow  share of the derivatives of the target that it has in statics
/// @param state  at the start of the step, then at its end
template <class Number>
Number relaxed(const Number& target, const Number& delay, double step, double follow,
               double& state) {
  if (step <= 0.0) {
    state = value_of(target);
    return chain(target, state, follow);
  }
  const double from = state;
  const Number end = lag_step<Number>(from, target, lag_share(Number(step / delay)));
  state = value_of(end);
  return 0.5 * (end + from);
}

}  // namespace culm::strip
