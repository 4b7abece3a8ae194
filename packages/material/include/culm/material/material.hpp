/// What solids are made of.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/material/neo_hooke.hpp>
#include <culm/material/plane_stress_plasticity.hpp>
#include <culm/material/st_venant_kirchhoff.hpp>
#include <culm/mechanics/relaxation.hpp>

#include <optional>
#include <variant>
#include <vector>

namespace culm::material {

/// Plasticity of a layer, at the points of some Simpson rules across its thickness.
struct LayerPlasticity {
  PlaneStressPlasticity law;
  int cells = 0;  ///< each with a rule of three points
};

/// A law with the density and the losses of the solid. Laws answer in the axes of the material.
struct Material {
  using Law = std::variant<StVenantKirchhoff, NeoHooke>;

  Law law;
  double density = 0.0;                        ///< [kg/m^3]
  double dissipation = 0.0;                    ///< numerical dissipation χ, formulation 4.5 [-]
  double damping = 0.0;                        ///< time by which stress runs ahead of strain [s]
  std::vector<MaxwellBranch> relaxation = {};  ///< each with one ratio
  /// Coefficients of thermal expansion along the axes of the material [1/K]
  Vec3 expansion = Vec3::Zero();
  /// How layers yield, if they do, in their plane.
  std::optional<LayerPlasticity> plasticity = {};

  /// Stiffness of the branches of one time over the lasting one; 0 if there are none [-]
  double ratio_of(double time) const;
  /// Whether stress is proportional to strain.
  bool is_linear() const { return std::holds_alternative<StVenantKirchhoff>(law); }
};

/// Stiffness at small strains of any law [N/m^2]
const Mat6& small_strain_stiffness(const Material::Law& law);

/// `Density`, `Dissipation`, `Damping` and `Relaxation`, which every type of material has.
Schema common_material_schema();
/// A material of a law with those.
Material make_material(Material::Law law, const Options& options);

}  // namespace culm::material
