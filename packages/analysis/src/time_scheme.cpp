#include <culm/analysis/time_scheme.hpp>

#include <cmath>

namespace culm::analysis {

// Dv / h = 2 Dq / h^2 - 2 v / h
Stencil ConservingScheme::begin(model::State& state, double h) {
  state.acceleration_offset.resize(state.velocity.size());
  for (std::size_t i = 0; i < state.velocity.size(); ++i) {
    state.acceleration_offset[i] = -2.0 / h * state.velocity[i];
  }
  return Stencil::midpoint(h);
}

// v_next = 2 Dq / h - v, written as v + h a with the acceleration that was balanced: what rounding
// makes of 2 / h and 2 / h^2 would else pull the same way in every step and change the momenta.
void ConservingScheme::finish(model::State& state, double h) {
  const double inertia = Stencil::midpoint(h).inertia;
  for (std::size_t i = 0; i < state.velocity.size(); ++i) {
    const double moved = state.next[i] - state.prev[i];
    state.velocity[i] += h * (inertia * moved + state.acceleration_offset[i]);
  }
}

GeneralisedAlphaScheme::GeneralisedAlphaScheme(double spectral_radius)
    : GeneralisedAlphaScheme((2.0 * spectral_radius - 1.0) / (spectral_radius + 1.0),
                             spectral_radius / (spectral_radius + 1.0)) {}

GeneralisedAlphaScheme::GeneralisedAlphaScheme(double alpha_m, double alpha_f)
    : alpha_m_(alpha_m),
      alpha_f_(alpha_f),
      beta_(0.25 * (1.0 - alpha_m_ + alpha_f_) * (1.0 - alpha_m_ + alpha_f_)),
      gamma_(0.5 - alpha_m_ + alpha_f_) {}

void GeneralisedAlphaScheme::start(model::State& state) {
  acceleration_.assign(state.velocity.size(), 0.0);
}

// The accelerations of the method belong to times alpha_m - alpha_f steps later than their index.
double GeneralisedAlphaScheme::error_constant() const {
  return std::abs(beta_ - 1.0 / 6.0 + 0.5 * (alpha_m_ - alpha_f_));
}

// a_next = Dq / (beta h^2) - v / (beta h) - (1 / (2 beta) - 1) a;
// the equations hold with (1 - alpha_m) a_next + alpha_m a at q between the ends
Stencil GeneralisedAlphaScheme::begin(model::State& state, double h) {
  state.acceleration_offset.resize(state.velocity.size());
  for (std::size_t i = 0; i < state.velocity.size(); ++i) {
    state.acceleration_offset[i] = (1.0 - alpha_m_) * (-state.velocity[i] / (beta_ * h) -
                                                       (0.5 / beta_ - 1.0) * acceleration_[i]) +
                                   alpha_m_ * acceleration_[i];
  }
  return {h, 1.0 - alpha_f_, 1.0 - alpha_f_, (1.0 - alpha_m_) / (beta_ * h * h)};
}

void GeneralisedAlphaScheme::finish(model::State& state, double h) {
  for (std::size_t i = 0; i < state.velocity.size(); ++i) {
    const double next = (state.next[i] - state.prev[i]) / (beta_ * h * h) -
                        state.velocity[i] / (beta_ * h) - (0.5 / beta_ - 1.0) * acceleration_[i];
    state.velocity[i] += h * ((1.0 - gamma_) * acceleration_[i] + gamma_ * next);
    acceleration_[i] = next;
  }
}

void GeneralisedAlphaScheme::save(const assembly::System& system, Snapshot& snapshot) const {
  model::Coordinates all = acceleration_;
  if (!snapshot.is_for_memory()) system.complete(all);
  snapshot.set("scheme/acceleration", std::move(all));
}

void GeneralisedAlphaScheme::restore(const Snapshot& snapshot) {
  acceleration_ = snapshot.copy("scheme/acceleration");
}

}  // namespace culm::analysis
