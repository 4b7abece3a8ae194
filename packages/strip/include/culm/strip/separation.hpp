/// How far the flow stays attached to an airfoil, read from its lift in a steady flow.
#pragma once

#include <optional>
#include <span>

namespace culm::strip {

/// What Kirchhoff's law says at an angle, with derivatives by it [1/rad].
struct Attachment {
  double root = 0.0, root_slope = 0.0;            ///< of the attached share of the chord [-]
  double share = 0.0, share_slope = 0.0;          ///< attached share f, from 0 to 1 [-]
  double separated = 0.0, separated_slope = 0.0;  ///< lift of the flow that has left [-]
};

/// Kirchhoff's law C_l = s (alpha - alpha_0) (1 + sqrt f)^2 / 4 read backwards: the lift is that of
/// an attached flow, share f, and that of a separated one, C_l = f s (alpha - alpha_0) + (1 - f)
/// C_s.
/// @source fluids B4
struct Separation {
  double zero_lift = 0.0;          ///< alpha_0 [rad]
  double slope = 0.0;              ///< s, the largest of lines from there to the curve [1/rad]
  double first = 0.0, last = 0.0;  ///< angles outside of which nothing is attached [rad]

  /// @param lift, lift_slope  in a steady flow at the angle, and its derivative
  Attachment at(double alpha, double lift, double lift_slope) const;
  /// The lift of an attached flow.
  double attached(double alpha) const { return slope * (alpha - zero_lift); }
};

/// A point of a curve of lift.
struct LiftPoint {
  double alpha = 0.0;  ///< [rad]
  double lift = 0.0;
};

/// Of a curve that is linear between points with rising angles; nothing if the lift does not rise
/// through zero within 30 degrees from zero.
std::optional<Separation> find_separation(std::span<const LiftPoint> curve);

}  // namespace culm::strip
