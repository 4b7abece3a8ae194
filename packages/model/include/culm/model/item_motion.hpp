/// Motion of items whose number of nodes varies, without heap.
#pragma once

#include <culm/model/projection.hpp>

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

  ItemMotion(const NodeTable& table, const std::vector<int>& nodes, const State& state,
             double theta)
      : mid(3, 4 * static_cast<int>(nodes.size())), arms_mid(mid), next(mid), arms_next(mid) {
    int at = 0;
    for (int node : nodes) {
      next.template middleCols<4>(at) = NodeTable::slots(state.next, node);
      arms_next.template middleCols<4>(at) = arms_of(table, node, state.next);
      mid.template middleCols<4>(at) = (1.0 - theta) * NodeTable::slots(state.prev, node) +
                                       theta * next.template middleCols<4>(at);
      arms_mid.template middleCols<4>(at) = (1.0 - theta) * arms_of(table, node, state.prev) +
                                            theta * arms_next.template middleCols<4>(at);
      at += 4;
    }
  }

  Slots mid, arms_mid;  ///< (1 - theta) prev + theta next
  Slots next, arms_next;
};

}  // namespace culm::model
