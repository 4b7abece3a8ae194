/// Where the nodes of an element are in a step, and how their slots follow the unknowns.
#pragma once

#include <culm/mechanics/element.hpp>
#include <culm/model/projection.hpp>

#include <array>

namespace culm::model {

/// Slots of nodes side by side, K of each, shape (3, K N).
template <int K, std::size_t N>
Slots<K* static_cast<int>(N)> gather_slots(const std::array<int, N>& nodes, const Coordinates& q) {
  Slots<K* static_cast<int>(N)> slots;
  for (std::size_t a = 0; a < N; ++a) {
    slots.template middleCols<K>(K * static_cast<int>(a)) =
        NodeTable::slots(q, nodes[a]).template leftCols<K>();
  }
  return slots;
}

/// Slots of an element at both ends of the step and where forces act, and the arms there. `prev` is
/// not filled in statics. @see Arms @source formulation 0.3
template <class E>
struct ElementMotion {
  static constexpr int K = slots_of(E::node_kind);  ///< slots per node
  static constexpr int N = E::num_nodes;
  using ItemSlots = Slots<E::num_slots>;
  using ItemArms = std::array<Arms<K>, N>;

  ElementMotion(const NodeTable& table, const std::array<int, N>& nodes, const State& state,
                double theta, Form form) {
    next = gather_slots<K>(nodes, state.next);
    arms_next = arms_of_item(table, nodes, next, state.next, form);
    if (theta == 1.0) {
      mid = next;
      arms_mid = arms_next;
      return;
    }
    prev = gather_slots<K>(nodes, state.prev);
    mid = (1.0 - theta) * prev + theta * next;
    const ItemArms arms_prev = arms_of_item(table, nodes, prev, state.prev, form);
    for (std::size_t a = 0; a < N; ++a) arms_mid[a] = at_theta(theta, arms_prev[a], arms_next[a]);
  }

  ItemSlots prev, next, mid;
  ItemArms arms_next, arms_mid;

 private:
  // arms_of, of slots that are at hand
  static ItemArms arms_of_item(const NodeTable& table, const std::array<int, N>& nodes,
                               const ItemSlots& slots, const Coordinates& q, Form form) {
    ItemArms arms;
    for (int a = 0; a < N; ++a) {
      const int node = nodes[static_cast<std::size_t>(a)];
      Arms<K>& arm = arms[static_cast<std::size_t>(a)];
      arm.slots = slots.template middleCols<K>(K * a);
      arm.turns = form == Form::null_space && table.turns(node);
      if (table.is_slave(node)) {
        arm.slots.col(0) -= NodeTable::slots(q, table.master(node)).col(0);
      } else {
        arm.slots.col(0).setZero();
      }
    }
    return arms;
  }
};

}  // namespace culm::model
