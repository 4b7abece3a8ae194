#include <culm/model/element_contribution.hpp>
#include <culm/model/inertia.hpp>
#include <culm/model/mass_batch.hpp>
#include <culm/model/projection.hpp>

#include <algorithm>
#include <cmath>

namespace culm::model {

std::vector<int> MassBatch::blocks(int item, const UnknownTable& unknowns) const {
  return {unknowns.node_block(items_[static_cast<std::size_t>(item)].node)};
}

void MassBatch::place(Placement placement, Form form) {
  placement_ = std::move(placement);
  form_ = form;
  packs_.clear();
  alone_.clear();
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    const int node = local(i).node;
    const bool is_triad = nodes_.kind(node) == NodeKind::node12 && !nodes_.is_slave(node);
    if (form == Form::null_space && is_triad) {
      add_to_packs(i);
    } else {
      alone_.push_back(i);
    }
  }
}

void MassBatch::add_to_packs(std::size_t i) {
  if (packs_.empty() || packs_.back().count == pack_lanes) packs_.emplace_back();
  Together& pack = packs_.back();
  for (int l = pack.count; l < pack_lanes; ++l) {
    pack.items[static_cast<std::size_t>(l)] = i;
    set_mass(local(i).mass, l, pack.masses);
  }
  ++pack.count;
}

Verdict MassBatch::assemble(const State& state, const Stencil& stencil, Want want, Target& target) {
  if (stencil.inertia == 0.0 && want != Want::mass) return Verdict::ok;
  Verdict verdict = Verdict::ok;
  for (const Together& pack : packs_) {
    verdict = worse(verdict, assemble_pack(pack, state, stencil, want, target));
  }
  for (const std::size_t i : alone_) {
    const Verdict one = form_ == Form::null_space
                            ? assemble_item<NullSpace>(i, state, stencil, want, target)
                            : assemble_item<FullSpace>(i, state, stencil, want, target);
    verdict = worse(verdict, one);
  }
  return verdict;
}

// What assemble_item does with each.
Verdict MassBatch::assemble_pack(const Together& pack, const State& state, const Stencil& stencil,
                                 Want want, Target& target) const {
  if (want == Want::mass) {
    for (int l = 0; l < pack.count; ++l) {
      assemble_item<NullSpace>(pack.items[static_cast<std::size_t>(l)], state, stencil, want,
                               target);
    }
    return Verdict::ok;
  }
  const auto gather = [&](const Coordinates& q, Packs<12>& slots) {
    std::array<const double*, pack_lanes> rows{};
    std::ranges::transform(pack.items, rows.begin(), [&](std::size_t i) {
      return q.data() + NodeTable::offset(local(i).node);
    });
    to_lanes(rows, 12, slots.data());
  };
  PackMotion<1> motion;
  gather(state.prev, motion.prev);
  gather(state.next, motion.next);
  gather(state.acceleration_offset, motion.acceleration_offset);
  const bool with_tangent = want == Want::residual_and_tangent;
  PackSum<1> sum;
  evaluate_masses(pack.masses, motion, stencil, with_tangent, sum);
  std::array<RowMat<6, 6>, pack_lanes> tangents;
  if (with_tangent) {
    std::array<double*, pack_lanes> rows{};
    std::ranges::transform(tangents, rows.begin(), [](auto& tangent) { return tangent.data(); });
    from_lanes(sum.tangent.data(), 36, rows);
  }
  Verdict verdict = Verdict::ok;
  for (int l = 0; l < pack.count; ++l) {
    Vec6 residual;
    for (int c = 0; c < 6; ++c) residual[c] = sum.residual.of(l, c);
    if (!std::isfinite(residual.sum())) {
      verdict = Verdict::not_finite;
      continue;
    }
    const auto lane = static_cast<std::size_t>(l);
    add_to_target<1>(pack.items[lane], residual, with_tangent ? &tangents[lane] : nullptr,
                     placement_.scatter, target);
  }
  return verdict;
}

// M a with a = inertia (q_next - q_prev) + offset, and its derivative; or P^T M P at q_next
template <class Space>
Verdict MassBatch::assemble_item(std::size_t i, const State& state, const Stencil& stencil,
                                 Want want, Target& target) const {
  constexpr int W = Space::width;
  const Item& item = local(i);
  const Arms<4> arms_next = arms_of(nodes_, item.node, state.next);
  RowMat<W, W> block = RowMat<W, W>::Zero();
  if (want == Want::mass) {
    Space::add_pairs(item.mass, arms_next, arms_next, block);
    placement_.scatter.add_tangent(i, 0, 0, block, target);
    return Verdict::ok;
  }
  const double theta = stencil.theta;
  const Arms<4> arms_mid = at_theta(theta, arms_of(nodes_, item.node, state.prev), arms_next);
  const NodeSlots moved =
      NodeTable::slots(state.next, item.node) - NodeTable::slots(state.prev, item.node);
  const NodeSlots force = inertia_force<4>(
      item.mass, stencil.inertia * moved + NodeTable::slots(state.acceleration_offset, item.node));
  const Vec<12> slots = force.reshaped();
  RowMat<W, 1> residual;
  Space::reduce_rows(slots, arms_mid, residual);
  if (!std::isfinite(residual.sum())) return Verdict::not_finite;
  target.force_scale = std::max(target.force_scale, residual.template lpNorm<Eigen::Infinity>());
  placement_.scatter.add_residual(i, 0, residual.data(), target);
  if (want == Want::residual) return Verdict::ok;

  const SlotMatrix<4> scalars = stencil.inertia * item.mass;
  Space::add_pairs(scalars, arms_mid, arms_next, block);
  Space::add_turning(force, arms_next, theta, block);
  placement_.scatter.add_tangent(i, 0, 0, block, target);
  return Verdict::ok;
}

void MassBatch::add_mass_times(const Coordinates& acceleration, Coordinates& force) const {
  for (const Item& item : items_) {
    NodeTable::slots(force, item.node) +=
        inertia_force<4>(item.mass, NodeTable::slots(acceleration, item.node));
  }
}

void MassBatch::visit_masses(const MassVisitor& visit) const {
  for (const Item& item : items_) visit(std::span(&item.node, 1), item.mass);
}

double MassBatch::kinetic_energy(const Coordinates& velocity) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    if (!placement_.owned[i]) continue;
    const Item& item = local(i);
    sum += model::kinetic_energy<4>(item.mass, NodeTable::slots(velocity, item.node));
  }
  return sum;
}

void MassBatch::add_momentum(const Coordinates& q, const Coordinates& velocity,
                             Momentum& momentum) const {
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    if (!placement_.owned[i]) continue;
    const Item& item = local(i);
    add_item_momentum<4, 4>(item.mass, NodeTable::slots(q, item.node),
                            NodeTable::slots(velocity, item.node), momentum);
  }
}

}  // namespace culm::model
