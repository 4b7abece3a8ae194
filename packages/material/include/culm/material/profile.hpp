/// Homogeneous isotropic sections: a profile filled with a material.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/material/section.hpp>

namespace culm::material {

/// Geometry of a cross-section about its centroid, axes d1 and d2 being principal.
struct Profile {
  double area = 0.0;     ///< [m^2]
  double I1 = 0.0;       ///< int xi2^2, bending about d1 [m^4]
  double I2 = 0.0;       ///< int xi1^2, bending about d2 [m^4]
  double torsion = 0.0;  ///< St. Venant torsion constant [m^4]
  double k1 = 1.0;       ///< shear factor for forces along d1 [-]
  double k2 = 1.0;       ///< shear factor for forces along d2 [-]
  std::vector<Vec<2>> outline;
  std::vector<Fibre> fibres = {};  ///< where it yields
  FibrePattern pattern = {};
};

/// The beginning of the schema of a type with a profile: material, placement, the parameters that
/// override the constants of the profile, and the rules between them.
Schema profile_schema(std::string type, std::string doc);

/// Poisson's ratio as given, or from both moduli: E / (2 G) - 1 [-].
double poisson_ratio(const Options& options);

/// The section of a profile: centred, then placed by `Offset` and `Angle`.
Section make_section(const Profile& profile, const Options& options);

/// Counter-clockwise regular polygon for the outline of a circle.
std::vector<Vec<2>> circle_outline(double radius);
/// Counter-clockwise corners of a rectangle, width along d1, height along d2.
std::vector<Vec<2>> rectangle_outline(double width, double height);

}  // namespace culm::material
