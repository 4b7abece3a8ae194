#include <culm/base/text.hpp>
#include <culm/load/piecewise_linear.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace culm::load {

PiecewiseLinear::PiecewiseLinear(std::vector<double> arguments, std::vector<double> values)
    : arguments_(std::move(arguments)), values_(std::move(values)) {
  for (std::size_t i = 1; i < arguments_.size(); ++i) {
    slopes_.push_back((values_[i] - values_[i - 1]) / (arguments_[i] - arguments_[i - 1]));
  }
}

PiecewiseLinear PiecewiseLinear::proportional(double slope) { return {{0.0, 1.0}, {0.0, slope}}; }

std::string PiecewiseLinear::mistake(const std::vector<double>& arguments,
                                     const std::vector<double>& values) {
  if (arguments.size() != values.size() || arguments.size() < 2) {
    return "needs as many points as values, and two at least, got " +
           std::to_string(arguments.size()) + " and " + std::to_string(values.size());
  }
  const auto pair = std::adjacent_find(arguments.begin(), arguments.end(), std::greater_equal<>());
  if (pair == arguments.end()) return {};
  return "must increase, got " + format_number(pair[0]) + " before " + format_number(pair[1]);
}

std::size_t PiecewiseLinear::segment(double x) const {
  const auto after = std::upper_bound(arguments_.begin() + 1, arguments_.end() - 1, x);
  return static_cast<std::size_t>(after - arguments_.begin()) - 1;
}

double PiecewiseLinear::value(double x) const { return on_segment(segment(x), x); }

double PiecewiseLinear::slope(double x) const { return slopes_[segment(x)]; }

// With r = (x - a) / (b - a), piece i from r0 to r1 has the weight r1 - r0 in the mean, and its
// slope the weight (r1^2 - r0^2) / 2 in d mean / db = int (x - a) F' dx / (b - a)^2.
PiecewiseLinear::Mean PiecewiseLinear::mean(double a, double b) const {
  const auto [first, last] = std::minmax({segment(a), segment(b)});
  if (first == last) return {on_segment(first, 0.5 * (a + b)), 0.5 * slopes_[first]};
  const auto [low, high] = std::minmax({a, b});
  Mean mean;
  for (std::size_t i = first; i <= last; ++i) {
    const double x0 = i == first ? low : arguments_[i];
    const double x1 = i == last ? high : arguments_[i + 1];
    const double r0 = (x0 - a) / (b - a);
    const double r1 = (x1 - a) / (b - a);
    mean.value += std::abs(r1 - r0) * on_segment(i, 0.5 * (x0 + x1));
    mean.derivative += 0.5 * std::abs(r1 * r1 - r0 * r0) * slopes_[i];
  }
  return mean;
}

}  // namespace culm::load
