#include <culm/joint/prescribed.hpp>
#include <culm/math/quadrature.hpp>

#include <algorithm>
#include <cmath>

namespace culm::joint {
namespace {

using model::Amplitude;

// An integral, and that of the absolute value.
struct Sum {
  double value = 0.0;
  double size = 0.0;
};

Sum sum_over(const Amplitude& function, double start, double end) {
  constexpr int points = 5;
  const double half = 0.5 * (end - start);
  Sum result;
  for (const QuadraturePoint& point : gauss_legendre(points)) {
    const double value = half * point.weight * function.at(start + half * (1.0 + point.xi));
    result.value += value;
    result.size += std::abs(value);
  }
  return result;
}

// Halves an interval until both halves say what the whole says.
double refine(const Amplitude& function, double start, double end, const Sum& whole, int deepest) {
  constexpr double rounding = 1e-14;
  const double middle = 0.5 * (start + end);
  const Sum first = sum_over(function, start, middle);
  const Sum second = sum_over(function, middle, end);
  const double both = first.value + second.value;
  if (deepest == 0 || !(std::abs(both - whole.value) > rounding * (first.size + second.size))) {
    return both;
  }
  return refine(function, start, middle, first, deepest - 1) +
         refine(function, middle, end, second, deepest - 1);
}

double integrate(const Amplitude& function, double start, double end) {
  constexpr int deepest = 12;
  if (function.is_constant()) return (end - start) * function.at(start);
  double total = 0.0;
  double from = start;
  const auto add_until = [&](double to) {
    total += refine(function, from, to, sum_over(function, from, to), deepest);
    from = to;
  };
  auto corner = std::ranges::upper_bound(function.corners(), start);
  for (; corner != function.corners().end() && *corner < end; ++corner) add_until(*corner);
  add_until(end);
  return total;
}

}  // namespace

double Prescribed::integral(const model::State& state, double theta) const {
  const double length = theta * (state.time - state.time_prev);
  if (const model::Signal* signal = function.signal()) {
    return length * amount * signal->in_step(state, 0.5);
  }
  return amount * integrate(function, state.time_prev, state.time_prev + length);
}

}  // namespace culm::joint
