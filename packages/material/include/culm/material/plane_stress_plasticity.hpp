/// Plasticity of von Mises in plane stress, of layers.
#pragma once

#include <culm/material/plasticity.hpp>

namespace culm::material {

/// Components 11, 22, 12 with engineering shears; s = Q (e - p), Q of plane stress. With the
/// deviator s' = P s, the back stress b = 2/3 Hk P^-1 p and x = s - b,
///   sqrt(3/2 x . P x) <= y + Hi a    dp = dl P x    da = sqrt(2/3 x . P x) dl
///   W = 1/2 (e - p) . Q (e - p) + 1/3 Hk p . P^-1 p + 1/2 Hi a^2.
/// A step flows in the direction of x at theta, where the yield surface is obeyed: at its end in
/// statics, in its middle in the conserving step, where
///   s . (e_next - e_prev) = W_next - W_prev + y (a_next - a_prev) exactly.
/// Ends may then lie beyond the yield surface by an amount of second order.
/// @source Simo, Taylor, Int. J. Numer. Meth. Eng. 22 (1986) 649-670; generalised midpoint: Simo,
/// Hughes (1998), Computational Inelasticity, section 3.4
class PlaneStressPlasticity {
 public:
  static constexpr int num_strains = 3;
  using Flow = PlasticFlow<3>;

  PlaneStressPlasticity() = default;
  PlaneStressPlasticity(double young_modulus, double poisson_ratio, const Plasticity& plasticity);

  /// A step from a strain to another one, forces taken at `theta`.
  PlasticStep<3> step(const Vec3& prev, const Vec3& next, const Flow& flow,
                      double theta) const noexcept;
  /// Stored energy beyond 1/2 e . Q e [J/m^3]
  double energy(const Vec3& strain, const Flow& flow) const noexcept;
  /// Q p [N/m^2]
  Vec3 relief(const Flow& flow) const noexcept;
  /// sqrt(3/2 s . P s) [N/m^2]
  static double equivalent(const Vec3& stress) noexcept;
  /// Q e [N/m^2]
  Vec3 elastic(const Vec3& strain) const noexcept;

 private:
  Vec3 q_ = Vec3::Zero();  // Q of the modes (1, 1, 0), (1, -1, 0), (0, 0, 1), of length one
  Plasticity constants_;
};

}  // namespace culm::material
