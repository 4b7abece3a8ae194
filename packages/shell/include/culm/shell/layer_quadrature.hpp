/// Quadrature over the volume of a layered shell.
#pragma once

#include <culm/material/layup.hpp>
#include <culm/math/quadrature.hpp>

namespace culm::shell {

/// Calls visit(layer, ζ, weight) at the Gauss points of each layer, from the bottom upward; the
/// weights add up to the thickness [m].
template <class Visit>
void visit_thickness(const material::Layup& layup, int points_per_layer, Visit&& visit) {
  double bottom = -0.5 * layup.thickness();
  for (const material::Layer& layer : layup.layers) {
    for (const QuadraturePoint& point : gauss_legendre(points_per_layer)) {
      visit(layer, bottom + 0.5 * (1.0 + point.xi) * layer.thickness,
            0.5 * point.weight * layer.thickness);
    }
    bottom += layer.thickness;
  }
}

/// Calls visit(layer, ξ, η, ζ, weight) with as many Gauss points in each direction.
template <class Visit>
void visit_volume(const material::Layup& layup, int points, Visit&& visit) {
  for (const QuadraturePoint& xi : gauss_legendre(points)) {
    for (const QuadraturePoint& eta : gauss_legendre(points)) {
      visit_thickness(layup, points, [&](const material::Layer& layer, double zeta, double weight) {
        visit(layer, xi.xi, eta.xi, zeta, xi.weight * eta.weight * weight);
      });
    }
  }
}

}  // namespace culm::shell
