/// Resultants of loads from fluids.
#pragma once

#include <culm/math/types.hpp>

#include <optional>

namespace culm::flow {

/// A load from a fluid that knows its resultant.
class FluidForce {
 public:
  virtual ~FluidForce() = default;

  struct Resultant {
    Vec3 force = Vec3::Zero();   ///< [N]
    Vec3 moment = Vec3::Zero();  ///< about the origin [N m]
  };
  /// In the last accepted step, of what this rank counts in sums; nothing before the first, on all
  /// ranks alike.
  virtual std::optional<Resultant> resultant() const = 0;
};

}  // namespace culm::flow
