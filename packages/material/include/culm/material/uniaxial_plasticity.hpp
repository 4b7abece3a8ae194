/// Plasticity under stress in one direction, of fibres.
#pragma once

#include <culm/material/plasticity.hpp>
#include <culm/mechanics/stencil.hpp>

namespace culm::material {

/// s = E (e - p), back stress b = Hk p, yield stress y + Hi a: with |s - b| <= y + Hi a,
///   dp = sign(s - b) da    W = 1/2 E (e - p)^2 + 1/2 Hk p^2 + 1/2 Hi a^2.
/// While the strain of a step grows evenly, all integrals are exact: the end lies on the yield
/// surface, and at theta = 1/2 the stress is the mean over the step, so that
///   s (e_next - e_prev) = W_next - W_prev + y (a_next - a_prev)
/// however the step is cut by the yield surface. @source the law: Simo, Hughes (1998),
/// Computational Inelasticity, section 1.4; the mean follows from its integrals
class UniaxialPlasticity {
 public:
  static constexpr int num_strains = 1;
  using Flow = PlasticFlow<1>;

  UniaxialPlasticity() = default;
  UniaxialPlasticity(double young_modulus, const Plasticity& plasticity)
      : E_(young_modulus), constants_(plasticity) {}

  double young_modulus() const { return E_; }  ///< [N/m^2]
  /// A step from a strain to another one, forces taken at `theta`.
  PlasticStep<1> step(const Vec<1>& prev, const Vec<1>& next, const Flow& flow,
                      double theta) const noexcept;
  /// Stored energy beyond 1/2 E e^2 [J/m^3]
  double energy(const Vec<1>& strain, const Flow& flow) const noexcept;
  /// E p [N/m^2]
  Vec<1> relief(const Flow& flow) const noexcept { return E_ * flow.strain; }

  /// (1 - t) a + t b of all constants.
  static UniaxialPlasticity interpolate(const UniaxialPlasticity& a, const UniaxialPlasticity& b,
                                        double t);

 private:
  double E_ = 0.0;
  Plasticity constants_;
};

}  // namespace culm::material
