/// Circular hollow section.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/material/profile.hpp>

namespace culm::material {

/// A circular ring.
struct TubeSection {
  static Schema schema();
  static Section make(const Options& options);

  /// Geometry of the profile. Shear factor: Cowper (1966), J. Appl. Mech. 33, 335-340.
  /// @param outer_radius, wall [m]
  /// @param nu                 Poisson ratio [-]
  static Profile profile(double outer_radius, double wall, double nu);
};

}  // namespace culm::material
