/// Solid rectangular section.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/material/profile.hpp>

namespace culm::material {

/// A filled rectangle.
struct RectangleSection {
  static Schema schema();
  static Section make(const Options& options);

  /// Geometry of the profile. Shear factor: Cowper (1966), J. Appl. Mech. 33, 335-340; torsion:
  /// exact series, Timoshenko, Goodier (1970), Theory of Elasticity, section 109.
  /// @param width, height  along d1, along d2 [m]
  /// @param nu             Poisson ratio [-]
  static Profile profile(double width, double height, double nu);
};

}  // namespace culm::material
