/// The wall of a shell: layers, one upon the other.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/material/material.hpp>
#include <culm/math/types.hpp>

#include <map>
#include <string>
#include <vector>

namespace culm::material {

/// One ply.
struct Layer {
  Material material;
  double thickness = 0.0;  ///< [m]
  double angle = 0.0;      ///< of the material axes about the normal, from the reference axis [rad]
};

/// Layers from the bottom (ζ = -t/2) upward. All have the same dissipation and damping, which act
/// on the element as a whole; each relaxes by branches of its own.
struct Layup {
  std::vector<Layer> layers;

  double thickness() const;  ///< [m]
  /// ζ at the bottom of a layer; at the top of the wall for layer = number of layers [m]
  double bottom(int layer) const;
  /// Relaxation times of all branches of all layers, each once, rising [s].
  std::vector<double> relaxation_times() const;
  /// Whether all materials answer in proportion to the strain.
  bool is_linear() const;
};

/// Stiffness (A B; B D) of classical laminate theory in the axes of the layup, order 11, 22, 12
/// with engineering shears: membrane forces [N/m] and moments [N] under strains and curvatures
/// [1/m] of the middle surface, free of stress across the thickness; at small strains for any law.
Mat6 laminate_stiffness(const Layup& layup);

/// Factors of the transverse shear stiffness along axes 1 and 2 by which a director that stays
/// straight stores the energy of the shear stresses that equilibrium asks for in cylindrical
/// bending about the other axis: (int E z^2)^2 / (int G int g^2 / G), g the first moment of E below
/// z about the neutral plane. 5/6 for a uniform wall.
/// @pre layup.is_linear()
/// @source Vlachoutsis, Int. J. Numer. Meth. Eng. 33 (1992) 1537-1546
Vec<2> shear_factors(const Layup& layup);

/// A layup whose layers have their transverse shear stiffness multiplied by factors along axes
/// 1, 2.
/// @pre layup.is_linear()
Layup with_shear_factors(Layup layup, const Vec<2>& factors);

/// One layer all through.
Layup single_layer(Material material, double thickness);

/// Fields that state a layup: `Material` or `Materials`, `Thickness` or `Thicknesses`, `Angles`,
/// `Repeat`, `Symmetric`, `Shear Correction`, and the rules between them.
Schema layup_schema();
/// The layup that the fields describe. Throws InputError for names that are not among `materials`
/// and for layers that do not go together.
Layup read_layup(const Options& options, const std::map<std::string, Material>& materials);

}  // namespace culm::material
