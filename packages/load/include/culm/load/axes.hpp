#pragma once

namespace culm::load {

/// What the components of a load refer to.
enum class Axes {
  space,      ///< fixed axes: a dead load
  directors,  ///< the directors of the node, with which the load turns: a follower load
};

}  // namespace culm::load
