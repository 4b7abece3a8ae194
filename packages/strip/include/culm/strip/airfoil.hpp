/// What a section does in a steady flow.
#pragma once

#include <culm/base/registry.hpp>
#include <culm/math/types.hpp>
#include <culm/strip/separation.hpp>

#include <memory>
#include <optional>

namespace culm::strip {

/// Coefficients of lift, drag and moment about the quarter chord, nose up, in this order [-].
using Coefficients = Vec3;

/// Coefficients by the angle of attack.
class Airfoil {
 public:
  virtual ~Airfoil() = default;
  /// @param alpha  angle of attack from -pi to pi [rad]
  /// @param slope  derivatives of the coefficients by it [1/rad]
  virtual Coefficients at(double alpha, Coefficients& slope) const = 0;
  /// Largest angle at which the coefficients mean something [rad]; none: all do.
  virtual std::optional<double> good_to() const { return {}; }
  /// How it stalls; null if it never does, or has no lift.
  virtual const Separation* separation() const { return nullptr; }
};

/// Shared by all stations that have it.
using SharedAirfoil = std::shared_ptr<const Airfoil>;
/// Types of the deck's list "Airfoils": Thin, Polar.
using AirfoilRegistry = Registry<SharedAirfoil>;

void register_airfoils(AirfoilRegistry& registry);

}  // namespace culm::strip
