#pragma once

#include <culm/math/types.hpp>
#include <culm/model/state.hpp>

#include <string>

namespace culm::model {

/// A load whose force is the multiplier of a constraint, as that of a prescribed velocity.
class ReactionSource {
 public:
  virtual ~ReactionSource() = default;
  /// Force [N] and moment about the node [N m] that it exerts there in a step.
  /// @param constraint name of the only one to count; all if empty
  virtual Vec6 reaction(int node, const State& state, const std::string& constraint) const = 0;
};

}  // namespace culm::model
