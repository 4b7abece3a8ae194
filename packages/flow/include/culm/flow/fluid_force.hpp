/// Resultants of loads from fluids.
#pragma once

#include <culm/flow/flow.hpp>
#include <culm/math/types.hpp>
#include <culm/model/booked.hpp>

#include <optional>

namespace culm::flow {

/// A load from a fluid that knows its resultant. Its work is booked as that of air, or of water
/// where the fluid is heavier than any gas.
class FluidForce : public model::Booked {
 public:
  struct Resultant {
    Vec3 force = Vec3::Zero();   ///< [N]
    Vec3 moment = Vec3::Zero();  ///< about the origin [N m]
  };
  /// In the last accepted step, of what this rank counts in sums; nothing before the first, on all
  /// ranks alike.
  virtual std::optional<Resultant> resultant() const = 0;

 protected:
  explicit FluidForce(const Flow& flow) : Booked(flow.density() < 100.0 ? "air" : "water") {}
};

}  // namespace culm::flow
