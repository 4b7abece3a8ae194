/// Elements of a batch that are evaluated several at a time.
#pragma once

#include <culm/mechanics/pack.hpp>
#include <culm/model/batch.hpp>
#include <culm/model/element_contribution.hpp>
#include <culm/model/point_laws.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace culm::model {

/// Residual and tangent of elements E of triads in the null-space form, pack by pack.
template <class E>
class ElementPacks {
 public:
  static constexpr int N = E::num_nodes;
  using Contribution = ElementContribution<NullSpace, E>;
  using Nodes = std::array<int, N>;

  /// Packs of `count` elements in place of all before. @param element  of each local item
  template <class ElementOf>
  void make(std::size_t count, ElementOf element) {
    packs_.clear();
    packs_.reserve((count + pack_lanes - 1) / pack_lanes);
    for (std::size_t first = 0; first < count; first += pack_lanes) {
      std::array<const E*, pack_lanes> lanes;
      for (std::size_t l = 0; l < pack_lanes; ++l)
        lanes[l] = &element(std::min(first + l, count - 1));
      packs_.emplace_back(lanes);
    }
  }

  /// What acts in the items of a pack.
  struct Input {
    const NodeTable& table;
    const State& state;
    const Stencil& stencil;
    const std::vector<Vec<E::num_strains>>& prev;  ///< strains at the start of the step, by point
    const std::vector<Vec<E::num_strains>>* predicted;  ///< stress of the tangent, by point, if any
    bool with_tangent;
  };
  /// Evaluates items and calls add(i, contribution) for each. @param nodes  of each local item
  template <class NodesOf, class Add>
  Verdict evaluate(std::size_t count, NodesOf nodes, const Input& input, Add add) {
    Verdict verdict = Verdict::ok;
    Contribution c(input.with_tangent);
    for (std::size_t first = 0; first < count; first += pack_lanes) {
      const std::size_t end = std::min(first + pack_lanes, count);
      for (std::size_t l = 0; l < pack_lanes; ++l) {
        const std::size_t i = std::min(first + l, end - 1);
        gather(i, nodes(i), static_cast<int>(l), input);
      }
      packs_[first / pack_lanes].evaluate(motion_, prev_.data(),
                                          input.predicted != nullptr ? predicted_.data() : nullptr,
                                          input.stencil, input.with_tangent, sum_);
      for (std::size_t i = first; i < end; ++i) {
        take(nodes(i), static_cast<int>(i - first), input, c);
        if (std::isfinite(c.residual.sum())) {
          add(i, c);
        } else {
          verdict = worse(verdict, Verdict::not_finite);
        }
      }
    }
    return verdict;
  }

 private:
  static constexpr int num_values = E::num_points * E::num_strains;

  void gather(std::size_t i, const Nodes& nodes, int l, const Input& input) {
    const State& state = input.state;
    const bool moves = input.stencil.theta != 1.0;
    const bool has_inertia = input.stencil.inertia != 0.0;
    for (int a = 0; a < N; ++a) {
      const int offset = NodeTable::offset(nodes[static_cast<std::size_t>(a)]);
      const double* next = state.next.data() + offset;
      const double* prev = state.prev.data() + offset;
      for (int c = 0; c < 12; ++c) motion_.next.of(l, 12 * a + c) = next[c];
      if (moves) {
        for (int c = 0; c < 12; ++c) motion_.prev.of(l, 12 * a + c) = prev[c];
      }
      if (!has_inertia) continue;
      const double* start = state.acceleration_offset.data() + offset;
      for (int c = 0; c < 12; ++c) {
        motion_.acceleration.of(l, 12 * a + c) =
            start[c] + input.stencil.inertia * (next[c] - prev[c]);
      }
    }
    for (int p = 0; p < E::num_points; ++p) {
      const std::size_t point = i * E::num_points + static_cast<std::size_t>(p);
      for (int s = 0; s < E::num_strains; ++s) {
        const int at = p * E::num_strains + s;
        prev_.of(l, at) = input.prev[point][s];
        if (input.predicted != nullptr) {
          predicted_.of(l, at) = (*input.predicted)[point][s];
        }
      }
    }
  }

  // The contribution of the item in a lane.
  void take(const Nodes& nodes, int l, const Input& input, Contribution& c) {
    for (int u = 0; u < 6 * N; ++u) c.residual[u] = sum_.residual.of(l, u);
    if (c.with_tangent) {
      double* tangent = c.tangent.data();
      for (int u = 0; u < 36 * N * N; ++u) tangent[u] = sum_.tangent.of(l, u);
    }
    for (int a = 0; a < N; ++a) {
      if (input.table.is_slave(nodes[static_cast<std::size_t>(a)]))
        add_lever(nodes, a, l, input, c);
    }
  }

  // A node at a lever moves by dx + dtheta x lever of its master.
  void add_lever(const Nodes& nodes, int a, int l, const Input& input, Contribution& c) const {
    const int node = nodes[static_cast<std::size_t>(a)];
    const double theta = input.stencil.theta;
    const Arms<4> next = arms_of(input.table, node, input.state.next);
    const Arms<4> mid =
        theta == 1.0 ? next : at_theta(theta, arms_of(input.table, node, input.state.prev), next);
    const Vec3 lever_mid = mid.slots.col(0);
    const Vec3 lever_next = next.slots.col(0);
    c.residual.template segment<3>(6 * a + 3) +=
        lever_mid.cross(Vec3(c.residual.template segment<3>(6 * a)));
    if (!c.with_tangent) return;
    auto& K = c.tangent;
    K.template middleRows<3>(6 * a + 3) += skew(lever_mid) * K.template middleRows<3>(6 * a);
    K.template middleCols<3>(6 * a + 3) -= K.template middleCols<3>(6 * a) * skew(lever_next);
    Slots<4> pull = Slots<4>::Zero();
    for (int i = 0; i < 3; ++i) pull(i, 0) = sum_.pull.of(l, 3 * a + i);
    NullSpace::add_turning(pull, Arms<4>{next.slots, true}, theta,
                           K.template block<6, 6>(6 * a, 6 * a));
  }

  std::vector<typename E::Pack> packs_;
  // of the pack that is evaluated
  PackMotion<N> motion_;
  PackSum<N> sum_;
  Packs<num_values> prev_, predicted_;
};

}  // namespace culm::model
