/// The line that hangs at rest between two points.
#pragma once

#include <culm/math/types.hpp>

#include <algorithm>
#include <cmath>

namespace culm::load {

/// An elastic line of one weight, without bending.
struct CatenaryLine {
  double length = 0.0;     ///< unstretched [m]
  double stiffness = 0.0;  ///< EA [N]
  double weight = 0.0;     ///< per unstretched length, in what surrounds it [N/m]
  bool on_seabed = false;  ///< rests on the plane through its anchor
  double friction = 0.0;   ///< C_B of that plane against a line that is pulled out [-]

  /// The same line on a seabed without friction.
  CatenaryLine without_friction() const { return {length, stiffness, weight, on_seabed, 0.0}; }
};

/// A line whose upper end, the fairlead, is held.
struct CatenaryEnds {
  double horizontal = 0.0;  ///< tension H in the plane, the same at both ends [N]
  double vertical = 0.0;    ///< V at the fairlead, positive downwards on it [N]
  double grounded = 0.0;    ///< unstretched length on the seabed [m]
  double energy = 0.0;      ///< weight and strain; its derivatives by h and z are H and V [J];
                            ///< with friction, which has none, that of the line without
  Mat<2, 2> K = Mat<2, 2>::Zero();  ///< derivative of (H, V) by (h, z) [N/m]
  bool found = false;               ///< H and V were found

  /// Tension at the fairlead [N].
  double fairlead_tension() const { return std::hypot(horizontal, vertical); }
  /// Tension at the anchor, which carries no weight of a line that rests on the seabed, and of H
  /// only what friction leaves [N].
  double anchor_tension(const CatenaryLine& line) const {
    if (grounded > 0.0) {
      return std::max(horizontal - line.friction * line.weight * grounded, 0.0);
    }
    return std::hypot(horizontal, vertical - line.weight * line.length);
  }
};

/// The line with its fairlead at the horizontal distance h > 0 from the anchor and z above it. On a
/// seabed with friction the tension falls by C_B w per length from where the line touches down, to
/// zero at the least: as after it was pulled out, wherever it was before. K is not symmetric then.
/// @source Jonkman, Dynamics modeling and loads analysis of an offshore floating wind turbine,
/// NREL/TP-500-41958 (2007), section 2.4
CatenaryEnds hang(const CatenaryLine& line, double h, double z);

}  // namespace culm::load
