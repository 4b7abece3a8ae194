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
}

Verdict MassBatch::assemble(const State& state, const Stencil& stencil, Want want, Target& target) {
  if (stencil.inertia == 0.0 && want != Want::mass) return Verdict::ok;
  Verdict verdict = Verdict::ok;
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    const Verdict one = form_ == Form::null_space
                            ? assemble_item<NullSpace>(i, state, stencil, want, target)
                            : assemble_item<FullSpace>(i, state, stencil, want, target);
    verdict = worse(verdict, one);
  }
  return verdict;
}

// M a with a = inertia (q_next - q_prev) + offset, and its derivative; or P^T M P at q_next
template <class Space>
Verdict MassBatch::assemble_item(std::size_t i, const State& state, const Stencil& stencil,
                                 Want want, Target& target) const {
  constexpr int W = Space::width;
  const Item& item = items_[static_cast<std::size_t>(placement_.items[i])];
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

void MassBatch::add_momentum(const Coordinates& q, const Coordinates& velocity,
                             Momentum& momentum) const {
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    if (!placement_.owned[i]) continue;
    const Item& item = items_[static_cast<std::size_t>(placement_.items[i])];
    add_item_momentum<4, 4>(item.mass, NodeTable::slots(q, item.node),
                            NodeTable::slots(velocity, item.node), momentum);
  }
}

}  // namespace culm::model
