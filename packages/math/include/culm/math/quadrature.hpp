/// Gauss-Legendre quadrature on [-1, 1].
#pragma once

#include <span>

namespace culm {

/// One point of a quadrature rule on [-1, 1].
struct QuadraturePoint {
  double xi;      ///< position in [-1, 1], ascending within a rule [-]
  double weight;  ///< the weights of a rule add up to 2 [-]
};

/// The Gauss-Legendre rule with 1 to 6 points, exact for polynomials up to degree 2 points - 1.
/// @pre 1 <= points <= 6
/// @source Abramowitz, Stegun (1964), table 25.4, in closed form up to 5 points
std::span<const QuadraturePoint> gauss_legendre(int points);

}  // namespace culm
