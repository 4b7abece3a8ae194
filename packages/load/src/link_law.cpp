#include <culm/load/link_law.hpp>

namespace culm::load {

// The mean of F over the step is DW / Du. The weight of the new strain in the stress adds to it as
// it does in linear elements: k ((1 - w) u + w u_next) = k (u + u_next) / 2 + (2 w - 1) k Du / 2.
LinkLaw::Answer SpringLaw::answer(double prev, double next, const model::State&,
                                  const Stencil& stencil) const {
  const double end = 2.0 * stencil.theta_strain - 1.0;
  const PiecewiseLinear::Mean mean = force_.mean(prev, next);
  return {(1.0 - end) * mean.value + end * force_.value(next),
          (1.0 - end) * mean.derivative + end * force_.slope(next)};
}

void SpringLaw::add_work(double force, double prev, double next, model::StepWork& work) const {
  work.dissipation += (force - force_.mean(prev, next).value) * (next - prev);
}

LinkLaw::Answer DamperLaw::answer(double prev, double next, const model::State&,
                                  const Stencil& stencil) const {
  if (stencil.step == 0.0) return {};
  const double rate = (next - prev) / stencil.step;
  return {force_.value(rate), force_.slope(rate) / stencil.step};
}

void DamperLaw::add_work(double force, double prev, double next, model::StepWork& work) const {
  work.damping += force * (next - prev);
}

LinkLaw::Answer DriveLaw::answer(double, double, const model::State& state,
                                 const Stencil& stencil) const {
  return {-amount_ * function_.in_step(state, stencil), 0.0, -amount_};
}

void DriveLaw::add_work(double force, double prev, double next, model::StepWork& work) const {
  work.external -= force * (next - prev);
}

}  // namespace culm::load
