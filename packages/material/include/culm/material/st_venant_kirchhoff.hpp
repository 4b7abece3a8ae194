/// Stress proportional to the Green-Lagrange strain.
#pragma once

#include <culm/math/types.hpp>
#include <culm/mechanics/stencil.hpp>

namespace culm::material {

/// W = 1/2 E . C E. Voigt order 11, 22, 33, 23, 13, 12 with engineering shears (2 E) in the
/// strains.
struct StVenantKirchhoff {
  Mat6 C = Mat6::Identity();  ///< symmetric, positive definite [N/m^2]

  /// Stored energy per reference volume [J/m^3]
  double energy(const Vec6& E) const noexcept { return 0.5 * E.dot(C * E); }
  /// Second Piola-Kirchhoff stress and its derivative [N/m^2]
  Verdict respond(const Vec6& E, Vec6& S, Mat6& tangent) const noexcept {
    S.noalias() = C * E;
    tangent = C;
    return Verdict::ok;
  }
  /// Stiffness at small strains [N/m^2]
  const Mat6& small_strain_stiffness() const noexcept { return C; }
};

}  // namespace culm::material
