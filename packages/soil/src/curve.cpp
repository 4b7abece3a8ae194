#include <culm/math/quadrature.hpp>
#include <culm/soil/curve.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::soil {
namespace {

// The whole table, with what it does on the other side and beyond its end.
load::PiecewiseLinear extended(const std::vector<double>& displacements,
                               const std::vector<double>& forces, TableCurve::Sides sides) {
  std::vector<double> y, p;
  const auto add = [&](double at, double force) {
    y.push_back(at);
    p.push_back(force);
  };
  const double last = displacements.back();
  if (sides == TableCurve::Sides::both) {
    add(-2.0 * last, -forces.back());
    for (std::size_t i = displacements.size(); i-- > 1;) add(-displacements[i], -forces[i]);
  } else {
    add(-last, 0.0);
  }
  for (std::size_t i = 0; i < displacements.size(); ++i) add(displacements[i], forces[i]);
  add(2.0 * last, forces.back());
  return {std::move(y), std::move(p)};
}

}  // namespace

// The difference of the potential, or where it would lose its digits, a quadrature.
Curve::Mean Curve::mean(double from, double to) const {
  constexpr double close = 1e-5;
  const double way = to - from;
  if (std::abs(way) > close * std::max(std::abs(from), std::abs(to))) {
    const double value = energy_between(from, to) / way;
    return {value, (force(to) - value) / way};
  }
  Mean mean;
  for (const QuadraturePoint& point : gauss_legendre(3)) {
    const double share = 0.5 * (1.0 + point.xi);
    const double at = from + share * way;
    mean.value += 0.5 * point.weight * force(at);
    mean.derivative += 0.5 * point.weight * share * slope(at);
  }
  return mean;
}

TableCurve::TableCurve(std::vector<double> displacements, std::vector<double> forces, Sides sides)
    : table_(extended(displacements, forces, sides)),
      knots_(displacements.begin() + 1, displacements.end()),
      first_(displacements[1]) {}

// The integral counts from the end of the table, beside which that of a small way is lost.
double TableCurve::energy_between(double from, double to) const {
  const bool is_line = from >= 0.0 && to >= 0.0 && std::max(from, to) <= first_;
  if (is_line) return 0.5 * (force(from) + force(to)) * (to - from);
  return energy(to) - energy(from);
}

}  // namespace culm::soil
