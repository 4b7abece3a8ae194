/// Parts of a model that turn steadily.
#pragma once

#include <culm/math/types.hpp>
#include <culm/mechanics/stencil.hpp>
#include <culm/model/state.hpp>

#include <span>
#include <vector>

namespace culm::model {

class Model;

/// A load that describes structures in a frame turning with them: what modes of a machine with
/// parts that turn and parts that do not have to know. Loads that are one derive from it.
class SteadyRotation {
 public:
  virtual ~SteadyRotation() = default;
  /// Unit vector; the frame turns about it by the right-hand rule.
  virtual const Vec3& axis() const = 0;
  /// A point of the axis [m].
  virtual const Vec3& point() const = 0;
  /// At the load level or time at which forces act in a step [rad/s].
  virtual double speed(const State& state, const Stencil& stencil) const = 0;
  /// Whether the frame describes a node.
  virtual bool turns(int node) const = 0;
};

/// The loads of a model that turn any of these nodes.
std::vector<const SteadyRotation*> rotations_of(const Model& model, std::span<const int> nodes);

}  // namespace culm::model
