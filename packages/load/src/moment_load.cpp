#include <culm/load/couple.hpp>
#include <culm/load/moment_load.hpp>
#include <culm/load/slot_kernel.hpp>
#include <culm/math/rotation.hpp>

#include <algorithm>
#include <cmath>

namespace culm::load {
namespace {

using NodeMotion = model::ItemMotion<1>;

// Forces on the directors as forces on slots.
NodeMotion::Slots on_slots(const Mat3& forces) {
  NodeMotion::Slots slots = NodeMotion::Slots::Zero(3, 4);
  slots.rightCols<3>() = forces;
  return slots;
}

}  // namespace

bool MomentLoad::has_tangent() const {
  return amplitude_.signal() != nullptr || axes_ == Axes::directors ||
         form() == model::Form::multipliers ||
         std::any_of(items_.begin(), items_.end(),
                     [this](const Item& item) { return on_shell(item); });
}

MomentLoad::Lost MomentLoad::lost() const {
  Lost lost;
  for (const Item& item : items_) {
    if (!on_shell(item) || item.components.isZero(0.0)) continue;
    const int node = item.nodes.front();
    const Vec3 director = model::NodeTable::slots(nodes_.reference(), node).col(1).normalized();
    const double share = std::abs(item.components.normalized().dot(director));
    if (share > lost.share) lost = {share, node};
  }
  return lost;
}

std::vector<int> MomentLoad::blocks(int item, const model::UnknownTable& unknowns) const {
  std::vector<int> result = {
      unknowns.node_block(items_[static_cast<std::size_t>(item)].nodes.front())};
  if (const model::Signal* signal = amplitude_.signal()) {
    result.push_back(unknowns.own_block(signal->block));
  }
  return result;
}

Verdict MomentLoad::assemble(const model::State& state, const Stencil& stencil, Want want,
                             model::Target& target) {
  const double factor = amplitude_.in_step(state, stencil);
  const bool tangent = want == Want::residual_and_tangent;
  return assemble_items([&](auto space, std::size_t i) {
    const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
    if (form() == model::Form::null_space && !on_shell(item)) {
      return assemble_reduced(i, motion(item, state, stencil.theta, factor), stencil.theta, tangent,
                              target);
    }
    return assemble_couple<decltype(space)>(i, state, stencil, factor, tangent, target);
  });
}

MomentLoad::Motion MomentLoad::motion(const Item& item, const model::State& state, double theta,
                                      double factor) const {
  Motion motion;
  motion.next = model::NodeTable::slots(state.next, item.nodes.front()).rightCols<3>();
  motion.mid =
      (1.0 - theta) * model::NodeTable::slots(state.prev, item.nodes.front()).rightCols<3>() +
      theta * motion.next;
  motion.components = factor * item.components;
  motion.unit = follows(item) ? Vec3(motion.mid * item.components) : item.components;
  motion.moment = factor * motion.unit;
  return motion;
}

// r_theta = -m      dr_theta / dtheta = theta sum_k M_k [d_k,next]
Verdict MomentLoad::assemble_reduced(std::size_t i, const Motion& motion, double theta,
                                     bool tangent, model::Target& target) const {
  if (!std::isfinite(motion.moment.sum())) return Verdict::not_finite;
  Vec6 residual;
  residual << Vec3::Zero(), -motion.moment;
  target.force_scale = std::max(target.force_scale, residual.lpNorm<Eigen::Infinity>());
  placement().scatter.add_residual(i, 0, residual.data(), target);
  if (!tangent) return Verdict::ok;
  if (const model::Signal* signal = amplitude_.signal()) {
    Vec6 derivative;
    derivative << Vec3::Zero(), -motion.unit;
    model::add_signal_column(placement().scatter, i, 0, 1, *signal, theta, derivative, target);
  }
  if (axes_ == Axes::space) return Verdict::ok;
  RowMat<6, 6> block = RowMat<6, 6>::Zero();
  block.bottomRightCorner<3, 3>() = theta * skew(motion.next * motion.components);
  placement().scatter.add_tangent(i, 0, 0, block, target);
  return Verdict::ok;
}

// r_d = -f of a couple, and of a moment that follows its directors dm / dd_j = M_j 1
template <class Space>
Verdict MomentLoad::assemble_couple(std::size_t i, const model::State& state,
                                    const Stencil& stencil, double factor, bool tangent,
                                    model::Target& target) const {
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  const Motion now = motion(item, state, stencil.theta, factor);
  const NodeMotion motion(nodes_, item.nodes, state, stencil.theta);
  const Couple couple(now.mid, nodes_.kind(item.nodes.front()));
  const NodeMotion::Slots r = on_slots(-couple.forces(now.moment));
  const Verdict verdict = add_slot_residual<Space>(placement(), i, r, motion.arms_mid, target);
  if (!tangent || verdict != Verdict::ok) return verdict;
  if (const model::Signal* signal = amplitude_.signal()) {
    add_signal_columns<Space>(placement(), i, on_slots(-couple.forces(now.unit)), motion.arms_mid,
                              *signal, stencil.theta, target);
  }
  Mat<9, 9> by_directors = couple.derivative(now.moment);
  if (follows(item)) {
    for (int j = 0; j < 3; ++j) {
      by_directors.middleCols<3>(3 * j) += now.components[j] * couple.by_moment();
    }
  }
  Mat<12, 12> K = Mat<12, 12>::Zero();
  K.bottomRightCorner<9, 9>() = -stencil.theta * by_directors;
  add_dense_derivative<Space>(
      placement(), i, r, motion, stencil.theta, [&](int, int) { return K; }, target);
  return Verdict::ok;
}

model::StepWork MomentLoad::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  const double factor = amplitude_.in_step(state, stencil);
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
    if (on_shell(item)) {
      const NodeMotion now(nodes_, item.nodes, state, stencil.theta);
      const Couple couple(now.mid.rightCols<3>(), NodeKind::node6);
      add_item_work(on_slots(couple.forces(factor * item.components)), now, item.nodes, state, true,
                    work);
      continue;
    }
    const Vec3 moment = motion(item, state, stencil.theta, factor).moment;
    const Mat3 prev = model::NodeTable::slots(state.prev, item.nodes.front()).rightCols<3>();
    const Mat3 next = model::NodeTable::slots(state.next, item.nodes.front()).rightCols<3>();
    work.external += moment.dot(cayley_vector(prev, next));
    work.moment += moment;
  }
  return work;
}

}  // namespace culm::load
