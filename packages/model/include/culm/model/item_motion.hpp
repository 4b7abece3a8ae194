/// Motion of items whose number of nodes varies, without heap.
#pragma once

#include <culm/model/projection.hpp>

#include <array>
#include <vector>

namespace culm::model {

/// Slots of up to MaxNodes nodes side by side, shape (3, 4 n).
template <int MaxNodes>
using BoundedSlots = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 4 * MaxNodes>;

/// Slots and arms of an item where forces act, at theta, and at the end of the step.
/// @see NullSpace, arms_of
template <int MaxNodes>
struct ItemMotion {
  using Slots = BoundedSlots<MaxNodes>;
  using NodeArms = std::array<Arms<4>, MaxNodes>;

  ItemMotion(const NodeTable& table, const std::vector<int>& nodes, const State& state,
             double theta)
      : mid(3, 4 * static_cast<int>(nodes.size())), next(mid) {
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const int node = nodes[a];
      const int at = 4 * static_cast<int>(a);
      next.template middleCols<4>(at) = NodeTable::slots(state.next, node);
      mid.template middleCols<4>(at) = (1.0 - theta) * NodeTable::slots(state.prev, node) +
                                       theta * next.template middleCols<4>(at);
      arms_next[a] = arms_of(table, node, state.next);
      arms_mid[a] = at_theta(theta, arms_of(table, node, state.prev), arms_next[a]);
    }
  }

  Slots mid;  ///< (1 - theta) prev + theta next
  Slots next;
  NodeArms arms_mid, arms_next;  ///< one entry per node of the item
};

}  // namespace culm::model
