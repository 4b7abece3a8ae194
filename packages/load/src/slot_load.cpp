#include <culm/base/error.hpp>
#include <culm/load/slot_kernel.hpp>
#include <culm/load/slot_load.hpp>
#include <culm/model/item_motion.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace culm::load {
namespace {

using SlotMotion = model::ItemMotion<SlotLoad::max_nodes>;
using ItemSlots = SlotMotion::Slots;

// Slots of an item as in SlotMotion; its arms would cost more than the work of the forces.
struct Ends {
  Ends(const std::vector<int>& nodes, const model::State& state, double theta)
      : mid(3, 4 * static_cast<int>(nodes.size())), next(mid) {
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const int at = 4 * static_cast<int>(a);
      next.middleCols<4>(at) = model::NodeTable::slots(state.next, nodes[a]);
      mid.middleCols<4>(at) = (1.0 - theta) * model::NodeTable::slots(state.prev, nodes[a]) +
                              theta * next.middleCols<4>(at);
    }
  }

  ItemSlots mid, next;
};

// x = sum_s T_s q_s of a material point
Eigen::VectorXd point_factors(const model::Marker& point) {
  Eigen::VectorXd T(4 * static_cast<int>(point.nodes.size()));
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    T.segment<4>(4 * static_cast<int>(a)) << point.weights[a], point.weights[a] * point.offset;
  }
  return T;
}

// F_k d_k = sum_s D_s q_s at a material point
Eigen::VectorXd follower_factors(const model::Marker& point, const Vec3& components) {
  Eigen::VectorXd D(4 * static_cast<int>(point.nodes.size()));
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    D.segment<4>(4 * static_cast<int>(a)) << 0.0, point.weights[a] * components;
  }
  return D;
}

}  // namespace

SlotLoad::Item& SlotLoad::item_on(const std::vector<int>& nodes) {
  internal_check(nodes.size() <= max_nodes, "a load acts on more nodes than SlotLoad provides for");
  if (size() == 0 || items_[size() - 1].nodes != nodes) {
    const int slots = 4 * static_cast<int>(nodes.size());
    items_.add({nodes, Eigen::Matrix3Xd::Zero(3, slots), {}});
  }
  return items_[size() - 1];
}

void SlotLoad::add_force(const model::Marker& point, const Vec3& components, Axes axes) {
  Item& item = item_on(point.nodes);
  const Eigen::VectorXd T = point_factors(point);
  if (axes == Axes::space) {
    item.constant += components * T.transpose();
  } else {
    if (item.linear.size() == 0) item.linear.setZero(T.size(), T.size());
    item.linear += T * follower_factors(point, components).transpose();
    item.follows = !item.linear.isZero(0.0);
    follows_ = follows_ || item.follows;
  }
}

void SlotLoad::add_slot_forces(int node, const model::NodeSlots& forces) {
  item_on({node}).constant += forces;
}

int SlotLoad::add_settable_force(int node) {
  items_.add({{node}, Eigen::Matrix3Xd::Zero(3, 4), {}, false, true});
  return size() - 1;
}

void SlotLoad::set_force(int item, const Vec3& force) {
  if (!items_.has(item)) return;  // another rank evaluates it
  Item& it = items_[item];
  internal_check(it.is_settable, "a force that is fixed was set");
  it.constant.col(0) = force;
}

std::vector<int> SlotLoad::blocks(int item, const model::UnknownTable& unknowns) const {
  std::vector<int> result;
  for (int node : items_[item].nodes) {
    result.push_back(unknowns.node_block(node));
  }
  if (const model::Signal* signal = amplitude_.signal()) {
    result.push_back(unknowns.own_block(signal->block));
  }
  return result;
}

bool SlotLoad::turns(const Item& item) const {
  for (std::size_t a = 0; a < item.nodes.size(); ++a) {
    const auto forces = item.constant.middleCols<4>(4 * static_cast<int>(a));
    const bool lever = nodes_.is_slave(item.nodes[a]);
    if (!forces.rightCols<3>().isZero(0.0) ||
        (lever && (item.is_settable || !forces.col(0).isZero(0.0)))) {
      return true;
    }
  }
  return false;
}

bool SlotLoad::has_tangent() const {
  if (has_tangent_) return *has_tangent_;
  return amplitude_.signal() != nullptr || follows_ ||
         std::ranges::any_of(items_.here(), [this](const Item& item) { return turns(item); });
}

void SlotLoad::place(model::Placement placement, model::Form form) {
  placement_ = std::move(placement);
  form_ = form;
  has_tangent_ = has_tangent();  // the same on all ranks, whatever they keep
  free_.clear();
  largest_dead_ = 0.0;
  others_.clear();
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    const Item& item = local(i);
    if (!is_free(item)) {
      others_.push_back(i);
      continue;
    }
    const int node = item.nodes[0];
    const Vec3 force = item.constant.col(0);
    const bool turns = nodes_.turns(node);
    const bool on_directors = !item.constant.rightCols<3>().isZero(0.0);
    const bool is_dead = turns && !on_directors && force.allFinite();
    const int row = is_dead ? placement_.scatter.whole_node_row(i, 0) : -1;
    free_.push_back({static_cast<int>(i), node, row, turns, on_directors, force});
    if (row >= 0) largest_dead_ = std::max(largest_dead_, force.lpNorm<Eigen::Infinity>());
  }
}

// Only the directors of its own node, if anything, turn such an item.
bool SlotLoad::is_free(const Item& item) const {
  return form_ == model::Form::null_space && item.nodes.size() == 1 && !item.follows &&
         !item.is_settable && amplitude_.signal() == nullptr && !nodes_.is_slave(item.nodes[0]);
}

Verdict SlotLoad::assemble(const model::State& state, const Stencil& stencil, Want want,
                           model::Target& target) {
  const double factor = amplitude_.in_step(state, stencil);
  const bool tangent = has_tangent() && want == Want::residual_and_tangent;
  const double largest = largest_dead_ > 0.0 ? std::abs(factor) * largest_dead_ : 0.0;
  Verdict verdict = std::isfinite(largest) ? Verdict::ok : Verdict::not_finite;
  target.force_scale = std::max(target.force_scale, largest);
  for (const Free& item : free_) {
    if (item.row >= 0) {
      double* out = target.residual.data() + item.row;
      for (int c = 0; c < 3; ++c) out[c] -= factor * item.force[c];
    } else {
      verdict = worse(verdict, assemble_free(item, state, stencil, factor, tangent, target));
    }
  }
  for (const std::size_t i : others_) {
    const Verdict one =
        form_ == model::Form::null_space
            ? assemble_item<model::NullSpace>(i, state, stencil, factor, tangent, target)
            : assemble_item<model::FullSpace>(i, state, stencil, factor, tangent, target);
    verdict = worse(verdict, one);
  }
  return verdict;
}

Eigen::Map<const model::NodeSlots> SlotLoad::forces_of(const Free& item) const {
  return Eigen::Map<const model::NodeSlots>(local(index(item.local)).constant.data());
}

// What assemble_item does, without looking for masters, slots of other nodes and signals.
Verdict SlotLoad::assemble_free(const Free& item, const model::State& state, const Stencil& stencil,
                                double factor, bool tangent, model::Target& target) const {
  const bool has_arms = item.turns && item.on_directors;
  Vec6 residual;
  residual.head<3>() = -factor * item.force;
  residual.tail<3>().setZero();
  if (has_arms) {
    const Eigen::Map<const model::NodeSlots> constant = forces_of(item);
    const model::NodeSlots mid =
        (1.0 - stencil.theta) * model::NodeTable::slots(state.prev, item.node) +
        stencil.theta * model::NodeTable::slots(state.next, item.node);
    for (int s = 1; s < 4; ++s) {
      residual.tail<3>() -= factor * Vec3(mid.col(s)).cross(Vec3(constant.col(s)));
    }
  } else if (!item.turns) {
    residual.tail<3>() = -factor * forces_of(item).col(1);
  }
  if (!std::isfinite(residual.sum())) return Verdict::not_finite;
  target.force_scale = std::max(target.force_scale, residual.lpNorm<Eigen::Infinity>());
  placement_.scatter.add_residual(index(item.local), 0, residual.data(), target);
  if (!tangent || !has_arms) return Verdict::ok;
  model::Arms<4> arms{model::NodeTable::slots(state.next, item.node)};
  arms.slots.col(0).setZero();
  RowMat<6, 6> block = RowMat<6, 6>::Zero();
  model::NullSpace::add_turning(-factor * forces_of(item), arms, stencil.theta, block);
  placement_.scatter.add_tangent(index(item.local), 0, 0, block, target);
  return Verdict::ok;
}

template <class Space>
Verdict SlotLoad::assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                                double factor, bool tangent, model::Target& target) const {
  const Item& item = local(i);
  const SlotMotion motion(nodes_, item.nodes, state, stencil.theta);
  const auto& [mid, next, arms_mid, arms_next] = motion;

  // r_s = -a (f0_s + sum_t L[s,t] q_t)
  ItemSlots r = -factor * item.constant;
  if (item.follows) r.noalias() -= factor * mid.lazyProduct(item.linear.transpose());
  const Verdict verdict = add_slot_residual<Space>(placement_, i, r, arms_mid, target);
  if (!tangent || verdict != Verdict::ok) return verdict;
  if (const model::Signal* signal = amplitude_.signal()) {
    ItemSlots unit = -item.constant;
    if (item.follows) unit.noalias() -= mid.lazyProduct(item.linear.transpose());
    add_signal_columns<Space>(placement_, i, unit, arms_mid, *signal, stencil.theta, target);
  }
  // P_theta^T (-a theta L x I3) P_next
  add_slot_derivative<Space>(
      placement_, i, r, motion, stencil.theta,
      [&](int a, int b, auto& block) {
        if (!item.follows) return;
        const SlotMatrix<4> pairs =
            -factor * stencil.theta * item.linear.template block<4, 4>(4 * a, 4 * b);
        Space::add_pairs(pairs, arms_mid[static_cast<std::size_t>(a)],
                         arms_next[static_cast<std::size_t>(b)], block);
      },
      target);
  return Verdict::ok;
}

bool SlotLoad::has_potential() const { return amplitude_.is_constant() && !follows_; }

double SlotLoad::stored_energy(const model::Coordinates& q) const {
  if (!has_potential()) return 0.0;
  double work = 0.0;
  for (const Free& item : free_) {
    if (!placement_.owned[index(item.local)]) continue;
    const auto slots = model::NodeTable::slots(q, item.node);
    work += item.force.dot(slots.col(0));
    if (!item.on_directors) continue;
    const auto forces = forces_of(item).rightCols<3>();
    work += forces.cwiseProduct(slots.rightCols<3>()).sum();
  }
  for (const std::size_t i : others_) {
    if (!placement_.owned[i]) continue;
    const Item& item = local(i);
    for (std::size_t a = 0; a < item.nodes.size(); ++a) {
      const auto forces = item.constant.middleCols<4>(4 * static_cast<int>(a));
      work += forces.cwiseProduct(model::NodeTable::slots(q, item.nodes[a])).sum();
    }
  }
  return -amplitude_.at(0.0) * work;
}

model::StepWork SlotLoad::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  const double factor = amplitude_.in_step(state, stencil);
  const bool works = !has_potential();
  const auto add = [&](std::size_t i) {
    const Item& item = local(i);
    const Ends ends(item.nodes, state, stencil.theta);
    ItemSlots f = factor * item.constant;
    if (item.follows) f.noalias() += factor * ends.mid.lazyProduct(item.linear.transpose());
    add_item_work(f, ends, item.nodes, state, works, work);
  };
  for (const Free& item : free_) {
    if (!placement_.owned[index(item.local)]) continue;
    if (works) {
      add(index(item.local));
    } else {
      add_push(item, state, stencil.theta, factor, work);
    }
  }
  for (const std::size_t i : others_) {
    if (placement_.owned[i]) add(i);
  }
  return work;
}

// What add_item_work adds of forces with a potential, which weight has on every node.
void SlotLoad::add_push(const Free& item, const model::State& state, double theta, double factor,
                        model::StepWork& work) const {
  const auto prev = model::NodeTable::slots(state.prev, item.node);
  const auto next = model::NodeTable::slots(state.next, item.node);
  const auto add_moment = [&](int s, const Vec3& force) {
    const Vec3 mid = (1.0 - theta) * prev.col(s) + theta * next.col(s);
    work.moment += mid.cross(Vec3(factor * force));
  };
  work.force += factor * item.force;
  add_moment(0, item.force);
  if (!item.on_directors) return;
  for (int s = 1; s < 4; ++s) add_moment(s, forces_of(item).col(s));
}

}  // namespace culm::load
