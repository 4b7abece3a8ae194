#include "interpolation.hpp"

#include <culm/base/error.hpp>
#include <culm/math/lagrange.hpp>

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

}  // namespace

Interpolation interpolate(Shape shape, std::size_t nodes, const Eigen::Vector2d& natural) {
  if (shape == Shape::node) return {Vec<1>::Ones(), Vec<1>::Zero(), Vec<1>::Zero()};
  if (shape == Shape::surface) return on_surface(natural);
  if (nodes == 2) return along_line<1>(natural[0]);
  if (nodes == 3) return along_line<2>(natural[0]);
  internal_check(nodes == 4, "a line has two to four nodes per element");
  return along_line<3>(natural[0]);
}

}  // namespace culm::port
