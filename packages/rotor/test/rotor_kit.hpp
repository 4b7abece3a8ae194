/// A wind, an airfoil and an element of a blade for tests of rotors.
#pragma once

#include <culm/flow/flow.hpp>
#include <culm/rotor/induction.hpp>
#include <culm/strip/airfoil.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace culm::rotor::test {

/// The same everywhere; it may be changed.
class Wind final : public flow::Flow {
 public:
  Wind(double density, const Vec3& steady) : Flow(density), velocity(steady) {}
  void velocities(std::span<const Vec3>, double, std::span<Vec3> velocities) const override {
    std::ranges::fill(velocities, velocity);
  }
  Vec3 velocity;
};

/// Smooth, with camber, drag and a stall that comes slowly.
class Airfoil final : public strip::Airfoil {
 public:
  strip::Coefficients at(double alpha, strip::Coefficients& slope) const override {
    slope = {4.0 * std::cos(2.0 * (alpha + 0.03)), alpha, 0.0};
    return {2.0 * std::sin(2.0 * (alpha + 0.03)), 0.01 + 0.5 * alpha * alpha, 0.0};
  }
};

/// At 40 m of a rotor of three blades; `axial` and `tangential` are of the wind that meets it.
inline BladeElement element(double axial, double tangential, double twist) {
  return {{3, 40.0, 1.5, 63.0}, {}, 3.0, twist, axial, tangential};
}

}  // namespace culm::rotor::test
