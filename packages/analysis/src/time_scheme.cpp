#include <culm/analysis/time_scheme.hpp>

#include <cmath>
#include <utility>

namespace culm::analysis {
namespace {

// v_next = 2 Dq / h - v, written as v + h a with the acceleration that was balanced: what rounding
// makes of 2 / h and 2 / h^2 would else pull the same way in every step and change the momenta.
void bring_to_end(model::Coordinates& velocity, const model::State& state, double h) {
  const double inertia = Stencil::midpoint(h).inertia;
  const auto faster = [h, inertia](double v, double next, double prev, double offset) {
    return v + h * (inertia * (next - prev) + offset);
  };
  model::combine(velocity, faster, state.next, state.prev, state.acceleration_offset);
}

}  // namespace

// Dv / h = 2 Dq / h^2 - 2 v / h
Stencil ConservingScheme::begin(model::State& state, double h) {
  state.acceleration_offset.resize(state.velocity.size());
  const auto offset = [h](double, double v) { return -2.0 / h * v; };
  model::combine(state.acceleration_offset, offset, state.velocity);
  return Stencil::midpoint(h);
}

model::Coordinates ConservingScheme::end_velocity(const model::State& state, double h) const {
  model::Coordinates velocity = state.velocity;
  bring_to_end(velocity, state, h);
  return velocity;
}

void ConservingScheme::finish(model::State& state, double h) {
  bring_to_end(state.velocity, state, h);
}

GeneralisedAlphaScheme::GeneralisedAlphaScheme(double spectral_radius)
    : GeneralisedAlphaScheme((2.0 * spectral_radius - 1.0) / (spectral_radius + 1.0),
                             spectral_radius / (spectral_radius + 1.0)) {}

GeneralisedAlphaScheme::GeneralisedAlphaScheme(double alpha_m, double alpha_f)
    : alpha_m_(alpha_m),
      alpha_f_(alpha_f),
      beta_(0.25 * (1.0 - alpha_m_ + alpha_f_) * (1.0 - alpha_m_ + alpha_f_)),
      gamma_(0.5 - alpha_m_ + alpha_f_) {}

void GeneralisedAlphaScheme::start(model::Coordinates acceleration) {
  acceleration_ = std::move(acceleration);
}

// The accelerations of the method belong to times alpha_m - alpha_f steps later than their index.
double GeneralisedAlphaScheme::error_constant() const {
  return std::abs(beta_ - 1.0 / 6.0 + 0.5 * (alpha_m_ - alpha_f_));
}

// a_next = Dq / (beta h^2) - v / (beta h) - (1 / (2 beta) - 1) a;
// the equations hold with (1 - alpha_m) a_next + alpha_m a at q between the ends
Stencil GeneralisedAlphaScheme::begin(model::State& state, double h) {
  state.acceleration_offset.resize(state.velocity.size());
  const auto offset = [this, h](double, double v, double a) {
    return (1.0 - alpha_m_) * (-v / (beta_ * h) - (0.5 / beta_ - 1.0) * a) + alpha_m_ * a;
  };
  model::combine(state.acceleration_offset, offset, state.velocity, acceleration_);
  return {h, 1.0 - alpha_f_, 1.0 - alpha_f_, (1.0 - alpha_m_) / (beta_ * h * h)};
}

model::Coordinates GeneralisedAlphaScheme::end_acceleration(const model::State& state,
                                                            double h) const {
  model::Coordinates result = acceleration_;
  const auto acceleration = [this, h](double a, double next, double prev, double v) {
    return (next - prev) / (beta_ * h * h) - v / (beta_ * h) - (0.5 / beta_ - 1.0) * a;
  };
  model::combine(result, acceleration, state.next, state.prev, state.velocity);
  return result;
}

void GeneralisedAlphaScheme::bring_to_end(model::Coordinates& velocity,
                                          const model::Coordinates& end_acceleration,
                                          double h) const {
  const auto faster = [this, h](double v, double first, double last) {
    return v + h * ((1.0 - gamma_) * first + gamma_ * last);
  };
  model::combine(velocity, faster, acceleration_, end_acceleration);
}

model::Coordinates GeneralisedAlphaScheme::end_velocity(const model::State& state, double h) const {
  model::Coordinates velocity = state.velocity;
  bring_to_end(velocity, end_acceleration(state, h), h);
  return velocity;
}

void GeneralisedAlphaScheme::finish(model::State& state, double h) {
  model::Coordinates acceleration = end_acceleration(state, h);
  bring_to_end(state.velocity, acceleration, h);
  acceleration_ = std::move(acceleration);
}

void GeneralisedAlphaScheme::save(const assembly::System& system, Snapshot& snapshot) const {
  system.save(acceleration_, "scheme/acceleration", snapshot);
}

void GeneralisedAlphaScheme::restore(const assembly::System& system, const Snapshot& snapshot) {
  system.restore(snapshot, "scheme/acceleration", acceleration_);
}

}  // namespace culm::analysis
