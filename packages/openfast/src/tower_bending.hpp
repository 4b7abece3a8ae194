/// First bending frequency of a tower on what it stands on, for estimates.
#pragma once

#include "rayleigh.hpp"

#include <optional>

namespace culm::openfast {

/// A rigid body below a tower that floats: nothing holds it.
struct FloatingBase {
  double mass = 0.0;     ///< [kg]
  double inertia = 0.0;  ///< about its centre, of the bending [kg m^2]
  double depth = 0.0;    ///< of its centre below the tower's base [m]
};

/// Circular frequency of the first bending mode [rad/s]: Bernoulli beam of 40 Hermite elements, the
/// tip mass as a point, without weight. The base is clamped, or a floating body.
double first_bending(const Cantilever& tower, const std::optional<FloatingBase>& base = {});

/// The tower on a stretch of its lowest section that reaches `depth` [m] further down.
Cantilever extended(const Cantilever& tower, double depth);

}  // namespace culm::openfast
