/// Orthotropic St. Venant-Kirchhoff solid.
#pragma once

#include <culm/material/material.hpp>

#include <string>
#include <vector>

namespace culm::material {

/// The nine constants. nu_ij: strain in j under stress in i over strain in i, sign reversed.
struct OrthotropicConstants {
  double E1, E2, E3;        ///< [N/m^2]
  double nu12, nu13, nu23;  ///< [-]
  double G12, G13, G23;     ///< [N/m^2]
};

/// The deck type `Orthotropic`: nine constants and density.
struct OrthotropicMaterial {
  static Schema schema();
  static Material make(const Options& options);
  /// Inverse of the compliance (1.19)
  static StVenantKirchhoff law(const OrthotropicConstants& constants);
  /// What makes the constants impossible, one sentence each; empty if nothing does.
  static std::vector<std::string> mistakes(const OrthotropicConstants& constants);
};

}  // namespace culm::material
