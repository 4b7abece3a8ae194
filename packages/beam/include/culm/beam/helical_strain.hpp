/// Strains of the helix between two triads as functions of their relative motion.
#pragma once

#include <culm/math/types.hpp>

namespace culm::beam {

/// Relative motion of two triads in seven quadratic invariants, in this order:
///   c    (tr Lam - 1) / 2         cosine of the relative rotation
///   a_i  -1/2 eps_ijk Lam_jk      its axis times its sine
///   r_i  d_i^1 . (x2 - x1) / h    relative position, divided by the reference length h
/// where Lam_ij = d_i^1 . d_j^2. These are all combinations of the twelve invariants (Lam, r) of
/// formulation 1.3.5 on which the strains depend.
struct HelicalInvariants {
  static constexpr int size = 7;
  double c;
  Vec3 a;
  Vec3 r;

  explicit HelicalInvariants(const Vec<size>& z)
      : c(z[0]), a(z.segment<3>(1)), r(z.segment<3>(4)) {}
};

/// Strains e = (Γ, K) of the helix, with reference not subtracted; shape (6), unit 1 and 1/m:
///   psi = (theta / sin theta)(c) a ,  K = psi / h ,
///   Γ   = r - 1/2 psi x r + g(psi . psi) psi x (psi x r)                              (1.11)
Vec6 helical_strain(const Vec<7>& z, double h) noexcept;

/// Length of the rotation vector psi [rad]. For orthonormal triads the angle between them; near 2
/// pi g is singular, which only triads far from orthonormal can reach.
double helical_rotation(const Vec<7>& z) noexcept;

/// de/dz, shape (6, 7).
Mat<6, 7> helical_strain_gradient(const Vec<7>& z, double h) noexcept;

/// Gradient and Hessian of w . e(z) for constant weights w: shapes (7) and (7, 7).
struct WeightedHelicalStrain {
  Vec<7> gradient;
  Mat<7, 7> hessian;
};
WeightedHelicalStrain weigh_helical_strain(const Vec<7>& z, const Vec6& w, double h) noexcept;

/// e(z1) - e(z0) without cancellation: its relative error stays near round-off as z1 approaches z0,
/// which the quotients of a discrete derivative need.
Vec6 helical_strain_increment(const Vec<7>& z0, const Vec<7>& z1, double h) noexcept;

}  // namespace culm::beam
