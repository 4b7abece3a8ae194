/// Forces that answer a penetration.
#pragma once

#include <culm/mechanics/stencil.hpp>

namespace culm::contact {

/// The law of a depth, positive inside: the pressure is p = k depth beyond half of the smoothing,
/// zero above minus half of it, and a parabola in between; pushed in with a rate, p (1 + d rate),
/// never less than zero. @source Hunt and Crossley, Journal of Applied Mechanics 42 (1975) 440-445
struct Penalty {
  double stiffness = 0.0;  ///< k, of a unit of area [Pa/m]
  double smoothing = 0.0;  ///< depth over which the stiffness sets in; 0: at once [m]
  double damping = 0.0;    ///< d [s/m]

  double energy(double depth) const;    ///< of a unit of area [J/m^2]
  double pressure(double depth) const;  ///< its derivative [Pa]
  double slope(double depth) const;     ///< and the derivative of that [Pa/m]
};

/// What a penetration does in a step.
struct PenaltyResponse {
  double elastic = 0.0;   ///< pressure that is stored [Pa]
  double pressure = 0.0;  ///< all of it, >= 0 [Pa]
  double tangent = 0.0;   ///< its derivative by the depth at the end of the step [Pa/m]
};

/// From one depth to another. In the conserving step elastic (next - prev) is the difference of the
/// energies to rounding, however short the step is.
PenaltyResponse respond(const Penalty& law, double prev, double next, const Stencil& stencil);

}  // namespace culm::contact
