/// Solid circular section.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/material/profile.hpp>

namespace culm::material {

/// A filled circle.
struct CircleSection {
  static Schema schema();
  static Section make(const Options& options);

  /// Geometry of the profile. Shear factor: Cowper (1966), J. Appl. Mech. 33, 335-340.
  /// @param radius [m]
  /// @param nu     Poisson ratio [-]
  static Profile profile(double radius, double nu);
};

}  // namespace culm::material
