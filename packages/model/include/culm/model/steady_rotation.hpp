/// Parts of a model that turn steadily.
#pragma once

#include <culm/math/types.hpp>
#include <culm/model/state.hpp>

#include <vector>

namespace culm::model {

/// A load that describes structures in a frame turning with them: what modes of a machine with
/// parts that turn and parts that do not have to know. Loads that are one derive from it.
class SteadyRotation {
 public:
  virtual ~SteadyRotation() = default;
  /// Unit vector; the frame turns about it by the right-hand rule.
  virtual const Vec3& axis() const = 0;
  /// A point of the axis [m].
  virtual const Vec3& point() const = 0;
  /// At the load level or time of a state [rad/s].
  virtual double speed(const State& state) const = 0;
  /// Whether the frame describes a node.
  virtual bool turns(int node) const = 0;
};

}  // namespace culm::model
