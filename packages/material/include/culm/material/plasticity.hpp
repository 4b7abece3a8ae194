/// Plasticity of von Mises with linear hardening: what all its laws share.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/math/types.hpp>

#include <optional>

namespace culm::material {

/// Constants of a metal that yields.
struct Plasticity {
  double yield_stress = 0.0;  ///< in tension, before any hardening [N/m^2]
  double isotropic = 0.0;     ///< growth of the yield stress by plastic strain [N/m^2]
  double kinematic = 0.0;     ///< growth of the back stress by plastic strain, in tension [N/m^2]
};

/// What a point remembers, with L components of strain.
template <int L>
struct PlasticFlow {
  Vec<L> strain = Vec<L>::Zero();  ///< plastic, engineering shears [-]
  double accumulated = 0.0;        ///< equivalent plastic strain, grows only [-]
};

/// What flow makes of a step.
template <int L>
struct PlasticStep {
  PlasticFlow<L> next;       ///< at its end
  Vec<L> relief;             ///< by which the stress is below that of the elastic law [N/m^2]
  RowMat<L, L> slope;        ///< derivative of the relief by the strain at the end [N/m^2]
  double dissipation = 0.0;  ///< work turned into heat, >= 0 [J/m^3]
};

/// On the yield surface up to rounding: the next motion counts as elastic, as its direction is not
/// known. @param excess  of the stress over the yield stress
inline bool touches(double excess, double yield_stress) { return excess <= 1e-9 * yield_stress; }

/// `Yield Stress`, `Isotropic Hardening` and `Kinematic Hardening`.
Schema plasticity_schema();
/// Of the list "Plasticity" of a section or a material; nothing if it is not there.
std::optional<Plasticity> read_plasticity(const Options& options);

}  // namespace culm::material
