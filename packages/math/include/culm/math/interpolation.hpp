/// Polynomials through values at the points of a quadrature rule.
#pragma once

#include <culm/math/quadrature.hpp>

#include <cstddef>
#include <span>

namespace culm {

/// Lagrange's polynomial that is 1 at point k of a rule and 0 at its others, at a place xi [-].
double lagrange(std::span<const QuadraturePoint> rule, std::size_t k, double xi);

}  // namespace culm
