/// Loads whose values a program sets.
#pragma once

#include <culm/math/types.hpp>

#include <vector>

namespace culm::model {

/// A load on nodes that acts as it was last set, in every attempt of a step until it is set anew:
/// in statics the load at the new level, in dynamics the mean over the step. Zero before.
class NodalInput {
 public:
  virtual ~NodalInput() = default;
  /// The nodes it acts on, by number in the model.
  virtual const std::vector<int>& nodes() const = 0;
  /// @param i       which of nodes()
  /// @param force   in space [N]
  /// @param moment  in space, about the node [N m]
  virtual void set(std::size_t i, const Vec3& force, const Vec3& moment) = 0;
};

}  // namespace culm::model
