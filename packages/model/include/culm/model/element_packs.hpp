/// Elements of a batch that are evaluated several at a time.
#pragma once

#include <culm/base/large_vector.hpp>
#include <culm/math/fetch.hpp>
#include <culm/mechanics/pack.hpp>
#include <culm/model/batch.hpp>
#include <culm/model/projection.hpp>

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
  static constexpr int W = 6 * N;  ///< unknowns of an element
  using Nodes = std::array<int, N>;

  /// What an element adds to the equations. Numbers come by lines of the cache, and none in two.
  struct alignas(sizeof(Pack)) Contribution {
    RowMat<W, W> tangent;
    Vec<W> residual;
  };

  /// Packs of `count` items in place of all before. @param item  of each number: element and nodes
  template <class ItemOf>
  void make(std::size_t count, ItemOf item) {
    count_ = count;
    packs_.clear();
    nodes_.clear();
    packs_.reserve((count + pack_lanes - 1) / pack_lanes);
    nodes_.reserve(packs_.capacity());
    for (std::size_t first = 0; first < count; first += pack_lanes) {
      std::array<const E*, pack_lanes> elements;
      Lanes lanes;
      for (std::size_t l = 0; l < pack_lanes; ++l) {
        const auto& one = item(std::min(first + l, count - 1));
        elements[l] = &one.element;
        lanes[l] = one.nodes;
      }
      packs_.emplace_back(elements, packs_.empty() ? nullptr : &packs_.back());
      nodes_.push_back(lanes);
    }
    stress_.clear();
    is_extrapolated_ = false;
  }

  bool empty() const { return packs_.empty(); }

  /// Calls visit(number, energy) with what the strains at q store, less those at `less` where that
  /// is given.
  template <class Visit>
  void for_energies(const Coordinates& q, const Coordinates* less, Visit visit) const {
    Packs<12 * N> slots, other;
    Pack energy;
    for (std::size_t pack = 0; pack < packs_.size(); ++pack) {
      gather(nodes_[pack], q, slots);
      if (less != nullptr) gather(nodes_[pack], *less, other);
      packs_[pack].strain_energy(slots.data(), less != nullptr ? other.data() : nullptr, &energy);
      for_lanes(pack, [&](std::size_t i, int l) { visit(i, energy[l]); });
    }
  }

  /// Calls visit(number, kinetic energy).
  template <class Visit>
  void for_kinetic_energies(const Coordinates& velocity, Visit visit) const {
    Packs<12 * N> rates;
    Pack energy;
    for (std::size_t pack = 0; pack < packs_.size(); ++pack) {
      gather(nodes_[pack], velocity, rates);
      packs_[pack].kinetic_energy(rates.data(), &energy);
      for_lanes(pack, [&](std::size_t i, int l) { visit(i, energy[l]); });
    }
  }

  /// Calls visit(number, momentum).
  template <class Visit>
  void for_momenta(const Coordinates& q, const Coordinates& velocity, Visit visit) const {
    Packs<12 * N> slots, rates;
    PackMomentum sum;
    for (std::size_t pack = 0; pack < packs_.size(); ++pack) {
      gather(nodes_[pack], q, slots);
      gather(nodes_[pack], velocity, rates);
      packs_[pack].find_momentum(slots.data(), rates.data(), sum);
      for_lanes(pack, [&](std::size_t i, int l) {
        const auto vector = [l](const Packs<3>& v) {
          return Vec3(v.of(l, 0), v.of(l, 1), v.of(l, 2));
        };
        visit(i, Momentum{sum.kinetic_energy[l], vector(sum.linear), vector(sum.angular)});
      });
    }
  }

  /// Tangents belong to the stress of the motion again.
  void forget_extrapolation() { is_extrapolated_ = false; }

  /// Extrapolates the stress along an increment of the coordinates; tangents belong to it from now
  /// on.
  void extrapolate(const State& state, const Stencil& stencil, const Coordinates& increment) {
    stress_.resize(packs_.size());
    Packs<12 * N> change;
    const std::array read = {&state.next, stencil.theta_strain != 1.0 ? &state.prev : nullptr,
                             &increment};
    for (std::size_t pack = 0; pack < packs_.size(); ++pack) {
      gather(nodes_[pack], state, stencil.theta_strain != 1.0, false);
      gather(nodes_[pack], increment, change);
      fetch_pack(pack + 1, read);
      packs_[pack].extrapolate(motion_, change.data(), stencil, stress_[pack].data());
    }
    is_extrapolated_ = true;
  }

  /// While an item is added: the energy of what its strains change by [J], see `tells_change`.
  double change_energy(int lane) const { return sum_.change_energy[lane]; }
  /// Evaluates all items and calls add(number, lane, contribution) for each.
  template <class Add>
  Verdict evaluate(const NodeTable& table, const State& state, const Stencil& stencil,
                   bool with_tangent, Add add) {
    Verdict verdict = Verdict::ok;
    const std::array read = {&state.next, counts_start(stencil) ? &state.prev : nullptr,
                             stencil.inertia != 0.0 ? &state.acceleration_offset : nullptr};
    for (std::size_t pack = 0; pack < packs_.size(); ++pack) {
      const Lanes& lanes = nodes_[pack];
      gather(lanes, state, counts_start(stencil), stencil.inertia != 0.0);
      packs_[pack].evaluate(motion_, is_extrapolated_ ? stress_[pack].data() : nullptr, stencil,
                            with_tangent, sum_);
      take(with_tangent);
      for_lanes(pack, [&](std::size_t i, int l) {
        // a part after each element, as memory keeps those waiting that ask for much at once
        fetch_lane(pack + 2, index(l), read);
        const Nodes& nodes = lanes[index(l)];
        Contribution& c = contributions_[index(l)];
        for (int a = 0; a < N; ++a) {
          if (table.is_slave(nodes[index(a)])) {
            add_lever(nodes, a, l, table, state, stencil.theta, with_tangent, c);
          }
        }
        if (std::isfinite(c.residual.sum())) {
          add(i, l, c);
        } else {
          verdict = worse(verdict, Verdict::not_finite);
        }
      });
    }
    return verdict;
  }

 private:
  static constexpr int num_values = E::num_points * E::num_strains;
  using Lanes = std::array<Nodes, pack_lanes>;

  // Calls visit(number, lane) for the elements of a pack.
  template <class Visit>
  void for_lanes(std::size_t pack, const Visit& visit) const {
    const std::size_t first = pack * pack_lanes;
    const std::size_t end = std::min(first + pack_lanes, count_);
    for (std::size_t i = first; i < end; ++i) visit(i, static_cast<int>(i - first));
  }

  // Asks the memory for a pack that follows another one and for where its elements are, while the
  // one before is evaluated. Inlined, as compilers leave a function out that does nothing else.
  [[gnu::always_inline]] void fetch_pack(std::size_t pack,
                                         const std::array<const Coordinates*, 3>& all_read) const {
    for (std::size_t l = 0; l < pack_lanes; ++l) fetch_lane(pack, l, all_read);
  }

  // The same of one element, and its share of what belongs to all.
  [[gnu::always_inline]] void fetch_lane(std::size_t pack, std::size_t l,
                                         const std::array<const Coordinates*, 3>& all_read) const {
    if (pack >= packs_.size()) return;
    const auto fetch_share = [l](const auto& of_all) __attribute__((always_inline)) {
      constexpr std::size_t share = sizeof(of_all) / pack_lanes;
      fetch(reinterpret_cast<const char*>(&of_all) + l * share, share);
    };
    fetch_share(packs_[pack]);
    if (is_extrapolated_) fetch_share(stress_[pack]);
    for (const Coordinates* q : all_read) {
      if (q == nullptr) continue;
      for (const int node : nodes_[pack][l]) {
        fetch(q->data() + NodeTable::offset(node), 12 * sizeof(double));
      }
    }
    if (l == 0) packs_[pack].fetch_shared(packs_[pack - 1]);
  }

  static void gather(const Lanes& lanes, const Coordinates& q, Packs<12 * N>& slots) {
    std::array<const double*, pack_lanes> rows;
    for (std::size_t a = 0; a < N; ++a) {
      for (std::size_t l = 0; l < pack_lanes; ++l)
        rows[l] = q.data() + NodeTable::offset(lanes[l][a]);
      to_lanes(rows, 12, slots.data() + 12 * a);
    }
  }

  void gather(const Lanes& lanes, const State& state, bool with_start, bool with_inertia) {
    gather(lanes, state.next, motion_.next);
    if (with_start) gather(lanes, state.prev, motion_.prev);
    if (with_inertia) gather(lanes, state.acceleration_offset, motion_.acceleration_offset);
  }

  // The contributions of all lanes.
  void take(bool with_tangent) {
    std::array<double*, pack_lanes> rows;
    for (std::size_t l = 0; l < pack_lanes; ++l) rows[l] = contributions_[l].residual.data();
    from_lanes(sum_.residual.data(), W, rows);
    if (!with_tangent) return;
    for (std::size_t l = 0; l < pack_lanes; ++l) rows[l] = contributions_[l].tangent.data();
    from_lanes(sum_.tangent.data(), W * W, rows);
  }

  // A node at a lever moves by dx + dtheta x lever of its master.
  void add_lever(const Nodes& nodes, int a, int l, const NodeTable& table, const State& state,
                 double theta, bool with_tangent, Contribution& c) const {
    const int node = nodes[index(a)];
    const Arms<4> next = arms_of(table, node, state.next);
    const Arms<4> mid =
        theta == 1.0 ? next : at_theta(theta, arms_of(table, node, state.prev), next);
    const Vec3 lever_mid = mid.slots.col(0);
    const Vec3 lever_next = next.slots.col(0);
    c.residual.template segment<3>(6 * a + 3) +=
        lever_mid.cross(Vec3(c.residual.template segment<3>(6 * a)));
    if (!with_tangent) return;
    auto& K = c.tangent;
    K.template middleRows<3>(6 * a + 3) += skew(lever_mid) * K.template middleRows<3>(6 * a);
    K.template middleCols<3>(6 * a + 3) -= K.template middleCols<3>(6 * a) * skew(lever_next);
    Slots<4> pull = Slots<4>::Zero();
    for (int i = 0; i < 3; ++i) pull(i, 0) = sum_.pull.of(l, 3 * a + i);
    NullSpace::add_turning(pull, Arms<4>{next.slots, true}, theta,
                           K.template block<6, 6>(6 * a, 6 * a));
  }

  std::size_t count_ = 0;
  LargeVector<typename E::Pack> packs_;
  std::vector<Lanes> nodes_;               // of the lanes of each pack
  LargeVector<Packs<num_values>> stress_;  // extrapolated, by pack
  bool is_extrapolated_ = false;
  // of the pack that is evaluated
  PackMotion<N> motion_;
  PackSum<N> sum_;
  std::array<Contribution, pack_lanes> contributions_;
};

}  // namespace culm::model
