/// What an element adds to the equations, and how it gets there.
#pragma once

#include <culm/model/batch.hpp>
#include <culm/model/element_motion.hpp>
#include <culm/model/triad_tangent.hpp>

#include <algorithm>

namespace culm::model {

/// Adds residual and tangent of an element with N nodes in the unknowns that are solved for.
/// @param i  local number of the element @param tangent  nullptr where none is wanted
template <int N, int Size>
void add_to_target(std::size_t i, const Vec<Size>& residual, const RowMat<Size, Size>* tangent,
                   const Scatter& places, Target& target) {
  constexpr int W = Size / N;
  target.force_scale = std::max(target.force_scale, residual.template lpNorm<Eigen::Infinity>());
  for (int a = 0; a < N; ++a) places.add_residual(i, a, residual.data() + W * a, target);
  if (tangent == nullptr) return;
  for (int a = 0; a < N; ++a) {
    if constexpr (W == 6) {
      places.add_tangent_rows<N>(i, a, tangent->data() + 6 * a * Size, target);
    } else {
      for (int b = 0; b < N; ++b) {
        places.add_tangent(i, a, b, tangent->template block<W, W>(W * a, W * b), target);
      }
    }
  }
}

/// Residual and tangent of an element in the unknowns of a space, and the parts of the tangent that
/// come from scalars between slots and from forces on slots. @source formulation 5.2
template <class Space, class E>
struct ElementContribution {
  static constexpr int W = Space::width;
  static constexpr int K = slots_of(E::node_kind);  ///< slots per node
  static constexpr int N = E::num_nodes;
  static constexpr int S = E::num_slots;
  using Motion = ElementMotion<E>;

  /// @param tangent_wanted  its parts are left undefined if not
  explicit ElementContribution(bool tangent_wanted) : with_tangent(tangent_wanted) {
    if (!with_tangent) return;
    tangent.setZero();
    scalars.setZero();
    slot_force.setZero();
  }

  /// residual += P_theta^T f
  void add_slot_force(const Slots<S>& force, const Motion& motion) {
    for (int a = 0; a < N; ++a) {
      const Vec<3 * K> slots =
          force.template middleCols<K>(K * a).template reshaped<Eigen::AutoOrder>();
      Vec<W> reduced;
      Space::reduce_rows(slots, motion.arms_mid[static_cast<std::size_t>(a)], reduced);
      residual.template segment<W>(W * a) += reduced;
    }
  }

  /// Takes the tangent from slots of shell nodes to the unknowns of the masters that some of them
  /// turn with; triads have theirs already (ActsOnUnknowns).
  void turn_tangent(const Motion& motion, const NodeTable& table, const std::array<int, N>& nodes) {
    RowMat<W, W * N> reduced;
    for (int a = 0; a < N; ++a) {
      const auto at = static_cast<std::size_t>(a);
      if (!motion.arms_next[at].turns || table.kind(nodes[at]) == NodeKind::node12) continue;
      const Arms<2> arms_mid{motion.arms_mid[at].slots.template leftCols<2>(), true};
      const Arms<2> arms_next{motion.arms_next[at].slots.template leftCols<2>(), true};
      const RowMat<W, W* N> rows = tangent.template middleRows<W>(W * a);
      Space::reduce_rows(rows, arms_mid, reduced);
      tangent.template middleRows<W>(W * a) = reduced;
      const RowMat<W, W* N> columns = tangent.template middleCols<W>(W * a).transpose();
      Space::reduce_rows(columns, arms_next, reduced);
      tangent.template middleCols<W>(W * a) = reduced.transpose();
    }
  }

  /// Adds everything to the global residual and matrix. @param i  local number of the element
  void scatter(std::size_t i, const Motion& motion, double theta, const Scatter& places,
               Target& target) {
    if (with_tangent) add_scalars_and_forces(motion, theta);
    add_to_target<N>(i, residual, with_tangent ? &tangent : nullptr, places, target);
  }

  Vec<W* N> residual = Vec<W * N>::Zero();
  RowMat<W * N, W * N> tangent;
  SlotMatrix<S> scalars;
  Slots<S> slot_force;
  bool with_tangent;

 private:
  // Triads of chains turn all.
  static constexpr bool is_chain = Space::form == Form::null_space && K == 4 && N >= 2 && N <= 4;

  void add_scalars_and_forces(const Motion& motion, double theta) {
    if constexpr (is_chain) {
      add_triad_tangent<N>(scalars, slot_force, motion.arms_mid, motion.arms_next, theta, tangent);
    } else {
      for (int a = 0; a < N; ++a) {
        const Arms<K>& arms_mid = motion.arms_mid[static_cast<std::size_t>(a)];
        for (int b = 0; b < N; ++b) {
          auto block = tangent.template block<W, W>(W * a, W * b);
          const Arms<K>& arms_next = motion.arms_next[static_cast<std::size_t>(b)];
          Space::add_pairs(scalars.template block<K, K>(K * a, K * b), arms_mid, arms_next, block);
          if (a != b) continue;
          Space::add_turning(slot_force.template middleCols<K>(K * a), arms_next, theta, block);
        }
      }
    }
  }
};

}  // namespace culm::model
