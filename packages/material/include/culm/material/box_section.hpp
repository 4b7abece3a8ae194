/// Rectangular hollow section.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/material/profile.hpp>

namespace culm::material {

/// A rectangular box: flanges parallel to d1, webs parallel to d2.
struct BoxSection {
  /// Outer dimensions and thicknesses [m].
  struct Walls {
    double width;   ///< along d1
    double height;  ///< along d2
    double flange;  ///< thickness of the walls parallel to d1
    double web;     ///< thickness of the walls parallel to d2
  };

  static Schema schema();
  static Section make(const Options& options);

  /// Geometry of the profile: area and moments exact; shear factor of the thin-walled box by Cowper
  /// (1966), J. Appl. Mech. 33, 335-340; torsion by the formula of Bredt (1896) on the midline.
  /// @param nu  Poisson ratio [-]
  static Profile profile(const Walls& walls, double nu);
};

}  // namespace culm::material
