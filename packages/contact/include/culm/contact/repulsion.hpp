/// What points of two beams that touch do to each other.
#pragma once

#include <culm/mechanics/stencil.hpp>

namespace culm::contact {

/// The law of two points at the distance rho, y = rho^2: nothing beyond the reach R, the sum of
/// both radii, and within it the energy K (R^2 - y)^2 per length of one line and length of the
/// other. Summed over a straight line, the energy of a point at the distance D is 16/15 K (R^2 -
/// D^2)^(5/2), so that lines that lie along each other press with a force per length that grows
/// with the power 3/2 of their depth. Pushed in with a rate, the force is multiplied by 1 + d rate,
/// never less than zero. @source Grill, Wall and Meier, Int. J. Num. Meth. Eng. 121 (2020)
/// 4578-4612, for the idea
struct Repulsion {
  double reach = 0.0;     ///< R [m]
  double strength = 0.0;  ///< K [J/m^6]
  double damping = 0.0;   ///< d [s/m]

  /// With the force per length of two lines along each other at a depth. @pre 0 < depth < reach
  static Repulsion of_lines(double reach, double line_force, double depth, double damping);

  double energy(double y) const;  ///< [J/m^2]
};

/// What the distance of two points does in a step: the force on their difference r is 2 S r.
struct RepulsionResponse {
  double elastic = 0.0;  ///< S that is stored, <= 0 [N/m^3]
  double stress = 0.0;   ///< all of it, <= 0 [N/m^3]
  double tangent = 0.0;  ///< its derivative by y at the end of the step [N/m^5]
};

/// From one square of the distance to another. In the conserving step elastic (next - prev) is the
/// difference of the energies to rounding, however short the step is.
RepulsionResponse respond(const Repulsion& law, double prev, double next, const Stencil& stencil);

}  // namespace culm::contact
