/// What takes energy out of strains.
#pragma once

#include <culm/mechanics/relaxation.hpp>

#include <vector>

namespace culm::model {

/// What takes energy out of strains, in dynamics only.
struct StrainDamping {
  /// Numerical dissipation chi in [0, 1]: takes 1/2 chi De . C De per step and leaves the momenta;
  /// first order in the step. @source formulation 4.5
  double dissipation = 0.0;
  double viscosity = 0.0;  ///< physical damping eta [s]: stress C eta de/dt on top of C e
  /// Physical damping eta_I of each strain [s], on top of `viscosity`; empty if there is none.
  /// Stress sqrt(eta_I) C_IJ sqrt(eta_J) de_J/dt: eta_I C_II on the diagonal, and for any C it
  /// takes energy.
  std::vector<double> viscosities;
  /// Viscoelasticity: with a ratio for each strain, or with none where elements have a stiffness of
  /// their own for each branch. @see HasBranchStiffness
  std::vector<MaxwellBranch> branches = {};

  bool operator==(const StrainDamping&) const = default;
  /// The same for `count` strains from the place `first` on.
  StrainDamping of_strains(int first, int count) const {
    StrainDamping part = *this;
    if (!viscosities.empty()) {
      part.viscosities.assign(viscosities.begin() + first, viscosities.begin() + first + count);
    }
    for (MaxwellBranch& branch : part.branches) {
      const auto from = branch.ratios.begin() + first;
      branch.ratios = std::vector<double>(from, from + count);
    }
    return part;
  }
  /// Weight that the new strain gains over the old one in a step of length h.
  double weight(double h) const { return 0.5 * dissipation + viscosity / h; }
};

}  // namespace culm::model
