/// Friction between surfaces.
#pragma once

#include <culm/math/types.hpp>

#include <cmath>

namespace culm::contact {

/// Coulomb's law, regularised: per unit of the normal force -mu v / sqrt(|v|^2 + v0^2).
struct Friction {
  double coefficient = 0.0;  ///< mu [-]
  double slip = 1.0;         ///< v0, speed at which 71 % of the friction is there [m/s]

  /// Friction per unit of the normal force. @param v  relative velocity in the tangent plane [m/s]
  Vec3 share(const Vec3& v) const { return -coefficient / size(v) * v; }
  /// Its derivative by the velocity [s/m].
  Mat3 derivative(const Vec3& v) const {
    const double s = size(v);
    return -coefficient / s * (Mat3::Identity() - v * v.transpose() / (s * s));
  }

 private:
  double size(const Vec3& v) const { return std::sqrt(v.squaredNorm() + slip * slip); }
};

}  // namespace culm::contact
