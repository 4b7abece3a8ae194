/// What takes energy out of strains.
#pragma once

namespace culm::model {

/// What takes energy out of strains, in dynamics only.
struct StrainDamping {
  /// Numerical dissipation chi in [0, 1]: takes 1/2 chi De . C De per step and leaves the momenta;
  /// first order in the step. @source formulation 4.5
  double dissipation = 0.0;
  double viscosity = 0.0;  ///< physical damping eta [s]: stress C eta de/dt on top of C e

  bool operator==(const StrainDamping&) const = default;
  /// Weight that the new strain gains over the old one in a step of length h.
  double weight(double h) const { return 0.5 * dissipation + viscosity / h; }
};

}  // namespace culm::model
