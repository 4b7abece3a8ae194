#include "interpolation.hpp"

#include <culm/base/error.hpp>
#include <culm/math/lagrange.hpp>

#include <utility>

namespace culm::port {
namespace {

template <int Order>
Interpolation along_line(double xi) {
  return {Lagrange<Order>::values(xi), Lagrange<Order>::derivatives(xi), Vec<Order + 1>::Zero()};
}

Interpolation on_surface(const Eigen::Vector2d& natural) {
  const auto N = Lagrange<1>::values(natural[0]), M = Lagrange<1>::values(natural[1]);
  const auto dN = Lagrange<1>::derivatives(natural[0]), dM = Lagrange<1>::derivatives(natural[1]);
  const auto around = [](const Vec<2>& along, const Vec<2>& across) {
    return Vec<4>(along[0] * across[0], along[1] * across[0], along[1] * across[1],
                  along[0] * across[1]);
  };
  return {around(N, M), around(dN, M), around(N, dM)};
}

using NodeWeights = Vec<4>;  // of the node before, both nodes of the segment, and the node after

// Slopes at both nodes, times the length of the segment.
std::pair<NodeWeights, NodeWeights> slopes(const Spacing& s) {
  const NodeWeights chord(0.0, -1.0, 1.0, 0.0);
  NodeWeights first = chord, last = chord;
  if (s.before > 0.0) {
    first = (s.within / s.before * s.within * NodeWeights(-1.0, 1.0, 0.0, 0.0) + s.before * chord) /
            (s.before + s.within);
  }
  if (s.after > 0.0) {
    last = (s.within / s.after * s.within * NodeWeights(0.0, 0.0, -1.0, 1.0) + s.after * chord) /
           (s.after + s.within);
  }
  if (s.before == 0.0) first = 2.0 * chord - last;
  if (s.after == 0.0) last = 2.0 * chord - first;
  return {first, last};
}

// The weights of the nodes that are there.
Interpolation::Column of_nodes(const Spacing& s, const NodeWeights& w) {
  const int first = s.before > 0.0 ? 0 : 1, last = s.after > 0.0 ? 3 : 2;
  return w.segment(first, last - first + 1);
}

}  // namespace

// Hermite's cubics in t = (1 + xi) / 2
Interpolation interpolate(const Spacing& spacing, double xi) {
  const double t = 0.5 * (1.0 + xi);
  const auto [first, last] = slopes(spacing);
  const NodeWeights at_first = NodeWeights::Unit(1), at_last = NodeWeights::Unit(2);
  const NodeWeights N = (1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t) * at_first +
                        t * (1.0 - t) * (1.0 - t) * first + t * t * (3.0 - 2.0 * t) * at_last -
                        t * t * (1.0 - t) * last;
  const NodeWeights dN = 6.0 * t * (1.0 - t) * (at_last - at_first) +
                         (1.0 - t) * (1.0 - 3.0 * t) * first + t * (3.0 * t - 2.0) * last;
  const Interpolation::Column slope = of_nodes(spacing, 0.5 * dN);
  return {of_nodes(spacing, N), slope, Interpolation::Column::Zero(slope.size())};
}

Interpolation interpolate(Shape shape, std::size_t nodes, const Eigen::Vector2d& natural) {
  if (shape == Shape::node) return {Vec<1>::Ones(), Vec<1>::Zero(), Vec<1>::Zero()};
  if (shape == Shape::surface) return on_surface(natural);
  if (nodes == 2) return along_line<1>(natural[0]);
  if (nodes == 3) return along_line<2>(natural[0]);
  internal_check(nodes == 4, "a line has two to four nodes per element");
  return along_line<3>(natural[0]);
}

}  // namespace culm::port
