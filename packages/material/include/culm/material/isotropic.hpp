/// Isotropic St. Venant-Kirchhoff solid.
#pragma once

#include <culm/material/material.hpp>

namespace culm::material {

/// Stiffness λ 1 (x) 1 + 2 μ, Voigt order 11, 22, 33, 23, 13, 12 [N/m^2]
Mat6 lame_stiffness(double lambda, double mu);

/// The deck type `Isotropic`: E, nu and density.
struct IsotropicMaterial {
  static Schema schema();
  static Material make(const Options& options);
  /// @pre young_modulus > 0, -1 < poisson_ratio < 1/2
  static StVenantKirchhoff law(double young_modulus, double poisson_ratio);
};

/// `Young Modulus` and `Poisson Ratio` of a solid.
Schema isotropic_constants_schema(std::string type, std::string doc);

}  // namespace culm::material
