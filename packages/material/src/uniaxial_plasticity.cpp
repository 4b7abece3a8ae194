#include <culm/material/uniaxial_plasticity.hpp>

#include <algorithm>
#include <cmath>

namespace culm::material {

// With the part q of the step that is plastic, and De its strain,
//   p_next = p + c q De    mean of p = p + c q^2 De / 2    c = E / (E + Hi + Hk)
PlasticStep<1> UniaxialPlasticity::step(const Vec<1>& prev, const Vec<1>& next, const Flow& flow,
                                        double theta) const noexcept {
  const Plasticity& k = constants_;
  const double p = flow.strain[0];
  const double trial = E_ * (next[0] - p) - k.kinematic * p;
  const double yield = k.yield_stress + k.isotropic * flow.accumulated;
  const double excess = std::abs(trial) - yield;
  PlasticStep<1> step{flow, relief(flow), RowMat<1, 1>::Zero()};
  if (excess <= 0.0) return step;

  const double sign = trial > 0.0 ? 1.0 : -1.0;
  const double grown = excess / (E_ + k.isotropic + k.kinematic);
  const double change = E_ * std::abs(next[0] - prev[0]);
  const double q = change > 0.0 ? std::min(1.0, excess / change) : 0.0;
  step.next.strain[0] += sign * grown;
  step.next.accumulated += grown;
  step.dissipation = k.yield_stress * grown;
  const double mean = p + 0.5 * q * sign * grown;
  step.relief[0] = E_ * ((2.0 - 2.0 * theta) * mean + (2.0 * theta - 1.0) * step.next.strain[0]);
  if (touches(excess, yield)) return step;
  const double c = E_ / (E_ + k.isotropic + k.kinematic);
  step.slope(0, 0) = E_ * c * ((1.0 - theta) * q * (2.0 - q) + 2.0 * theta - 1.0);
  return step;
}

UniaxialPlasticity UniaxialPlasticity::interpolate(const UniaxialPlasticity& a,
                                                   const UniaxialPlasticity& b, double t) {
  const auto mean = [t](double of_a, double of_b) { return (1.0 - t) * of_a + t * of_b; };
  const Plasticity &k = a.constants_, &l = b.constants_;
  return {mean(a.E_, b.E_),
          {mean(k.yield_stress, l.yield_stress), mean(k.isotropic, l.isotropic),
           mean(k.kinematic, l.kinematic)}};
}

double UniaxialPlasticity::energy(const Vec<1>& strain, const Flow& flow) const noexcept {
  const double p = flow.strain[0];
  return E_ * p * (0.5 * p - strain[0]) + 0.5 * constants_.kinematic * p * p +
         0.5 * constants_.isotropic * flow.accumulated * flow.accumulated;
}

}  // namespace culm::material
