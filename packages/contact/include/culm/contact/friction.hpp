/// Friction between surfaces.
#pragma once

#include <culm/math/types.hpp>

namespace culm::contact {

/// Coulomb's law with the coefficient mu, regularised.
struct Friction {
  double coefficient = 0.0;  ///< mu [-]
  double slip = 1.0;         ///< v0, speed at which 71 % of the friction is there [m/s]
};

/// The friction on a surface that moved along another one in a step, and its derivatives.
struct Rubbing {
  Vec3 force = Vec3::Zero();      ///< [N]
  Mat3 by_way = Mat3::Zero();     ///< by how far it moved [N/m]
  Vec3 by_normal = Vec3::Zero();  ///< by the normal force [-]
};

/// In motion: -mu N v / sqrt(|v|^2 + v0^2) of the velocity v = way / step.
/// @param normal  force N that presses [N]
/// @param way     in the tangent plane [m]
Rubbing rub(const Friction& friction, double normal, const Vec3& way, double step);

/// At rest: -k way, but no more than mu N. At its limit, and not moved on, it sticks, so that
/// slopes about a state are those of a motion that turns.
/// @param stiffness  k of surfaces that stick [N/m]
/// @param way        in the tangent plane, with what the friction of before stands for, -F / k [m]
Rubbing stick(const Friction& friction, double normal, double stiffness, const Vec3& way);

}  // namespace culm::contact
