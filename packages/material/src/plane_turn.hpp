/// Strains in the plane of a layer, seen in other axes.
#pragma once

#include <culm/math/types.hpp>

#include <cmath>

namespace culm::material {

/// Strains 11, 22, 12 (engineering shear) in the axes of a material by those in axes turned back
/// from them by an angle [rad], those of the layup.
inline Mat3 plane_turn(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  Mat3 T;
  T << c * c, s * s, s * c, s * s, c * c, -s * c, -2.0 * s * c, 2.0 * s * c, c * c - s * s;
  return T;
}

}  // namespace culm::material
