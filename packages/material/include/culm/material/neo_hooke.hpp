/// Compressible Neo-Hooke law.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/math/types.hpp>
#include <culm/mechanics/stencil.hpp>

namespace culm::material {

struct Material;

/// W = μ/2 (tr C - 3 - 2 ln J) + λ/2 (ln J)^2 with C = 1 + 2 E, J^2 = det C. Voigt order 11, 22,
/// 33, 23, 13, 12 with engineering shears. Energy and stress keep their relative accuracy at small
/// strains. @source formulation 1.4, (1.20)
class NeoHooke {
 public:
  /// Lamé constants [N/m^2]; mu > 0, 3 lambda + 2 mu > 0
  NeoHooke(double lambda, double mu);
  /// The law whose stiffness at small strains has these constants. @pre -1 < nu < 1/2
  static NeoHooke from_moduli(double young_modulus, double poisson_ratio);

  /// The deck type `Neo-Hooke`: E, nu and density.
  static Schema schema();
  static Material make(const Options& options);

  /// Stored energy per reference volume [J/m^3]; NaN where det C <= 0
  double energy(const Vec6& E) const noexcept;
  /// Second Piola-Kirchhoff stress and its derivative [N/m^2]; law_out_of_range and zeros where
  /// det C <= 0
  Verdict respond(const Vec6& E, Vec6& S, Mat6& tangent) const noexcept;
  /// Stiffness at small strains [N/m^2]
  const Mat6& small_strain_stiffness() const noexcept { return small_; }

 private:
  double lambda_;
  double mu_;
  Mat6 small_;
};

}  // namespace culm::material
