/// One section in a uniform wind, for tests.
#pragma once

#include <culm/strip/strip_load.hpp>

#include <culm_kit/batch_laws.hpp>
#include <culm_kit/deck_list.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>

namespace culm::strip::test {

using kit::effect;

/// Force [N] and moment about the node [N m].
struct Resultant {
  Vec3 force = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
};

/// Of the deck, with some values given.
inline SharedAirfoil airfoil(const std::string& type, const kit::GivenValues& values) {
  AirfoilRegistry registry;
  register_airfoils(registry);
  const Schema schema = registry.variants().at(type);
  return registry.make(type, kit::deck_list(schema, values, "section"));
}

/// Lift and drag that vary with the angle in their own ways, and a moment.
class Bent final : public Airfoil {
 public:
  Coefficients at(double alpha, Coefficients& slope) const override {
    slope = {5.0 * std::cos(2.0 * alpha), 0.4 * alpha, 0.1};
    return {2.5 * std::sin(2.0 * alpha), 0.01 + 0.2 * alpha * alpha, -0.05 + 0.1 * alpha};
  }
};

class Wind final : public flow::Flow {
 public:
  Wind(double density, Vec3 velocity) : Flow(density), velocity_(std::move(velocity)) {}
  void velocities(std::span<const Vec3>, double, std::span<Vec3> velocities) const override {
    std::ranges::fill(velocities, velocity_);
  }

 private:
  Vec3 velocity_;
};

/// A section whose tail is along x and whose suction side is y; the span is z.
inline Station section(double chord, double axis_at, SharedAirfoil airfoil) {
  Station station;
  station.point = model::marker_at(0);
  station.length = 1.0;
  station.chord = chord;
  station.axis_at = axis_at;
  station.along = Vec3::UnitX();
  station.across = Vec3::UnitY();
  station.airfoil = std::move(airfoil);
  return station;
}

/// A section on a node that is moved as one likes: position and velocity in the plane, pitch nose
/// up, by the conserving scheme.
class MovedSection {
 public:
  MovedSection(const Station& station, StripModel kind, double density, const Vec3& wind,
               double step)
      : stencil_(Stencil::midpoint(step)) {
    model::NodeSlots slots;
    slots << Vec3::Zero(), Mat3::Identity();
    model_.nodes().add(slots);
    auto load = std::make_unique<StripLoad>(effect, model_.nodes(), model::Amplitude::constant(),
                                            std::make_shared<Wind>(density, wind), kind);
    load->add(station);
    load_ = load.get();
    model_.add_load(std::move(load));
    model_.freeze(model::Form::multipliers);
    dense_ = std::make_unique<kit::DenseAssembly>(model_);
    state_ = model_.initial_state();
    state_.velocity.assign(state_.prev.size(), 0.0);
    state_.acceleration_offset.assign(state_.prev.size(), 0.0);
  }

  /// Where the node is at the start, and how fast it moves.
  void start(const model::Coordinates& q, const model::Coordinates& velocity) {
    state_.prev = state_.next = q;
    state_.velocity = velocity;
  }
  /// One step to a place; the load of it, as force and moment about the node.
  Resultant go(const model::Coordinates& q, bool accept = true) {
    state_.next = q;
    state_.time = state_.time_prev + stencil_.step;
    for (std::size_t i = 0; i < state_.velocity.size(); ++i) {
      state_.acceleration_offset[i] = -2.0 / stencil_.step * state_.velocity[i];
    }
    dense_->prepare(state_, stencil_);
    const Resultant load = resultant(stencil_);
    if (!accept) return load;
    dense_->accept(state_);
    for (std::size_t i = 0; i < state_.velocity.size(); ++i) {
      state_.velocity[i] =
          2.0 / stencil_.step * (state_.next[i] - state_.prev[i]) - state_.velocity[i];
    }
    state_.prev = state_.next;
    state_.time_prev = state_.time;
    return load;
  }
  Resultant resultant(const Stencil& stencil) {
    const Vec<12> forces = -dense_->residual(state_, stencil, {load_}).head<12>();
    const model::Coordinates q = kit::at_theta(state_, stencil.theta);
    Resultant total{forces.head<3>(), Vec3::Zero()};
    for (int slot = 1; slot < 4; ++slot) {
      const Vec3 director(q.data() + 3 * slot);
      total.moment += director.cross(forces.segment<3>(3 * slot));
    }
    return total;
  }

  StripLoad& load() { return *load_; }
  const Stencil& stencil() const { return stencil_; }
  model::State& state() { return state_; }

 private:
  Stencil stencil_;
  model::Model model_;
  StripLoad* load_ = nullptr;
  std::unique_ptr<kit::DenseAssembly> dense_;
  model::State state_;
};

/// Of a node at (x, y) whose directors are turned nose up.
inline model::Coordinates placed(double x, double y, double pitch) {
  const Vec3 d1(std::cos(pitch), -std::sin(pitch), 0.0), d2(std::sin(pitch), std::cos(pitch), 0.0);
  return {x, y, 0.0, d1[0], d1[1], d1[2], d2[0], d2[1], d2[2], 0.0, 0.0, 1.0};
}

}  // namespace culm::strip::test
