#include <culm/load/moment_load.hpp>
#include <culm/load/slot_kernel.hpp>
#include <culm/math/rotation.hpp>
#include <culm/model/signal_column.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace culm::load {
namespace {

using NodeMotion = model::ItemMotion<1>;

Vec3 director_force(const Vec3& moment, const Vec3& d) { return moment.cross(d) / d.squaredNorm(); }

// d f_d / d d = [m] / (d . d) - 2 (m x d) d^T / (d . d)^2
Mat3 director_derivative(const Vec3& moment, const Vec3& d) {
  const double square = d.squaredNorm();
  return (skew(moment) - 2.0 / square * moment.cross(d) * d.transpose()) / square;
}

}  // namespace

bool MomentLoad::has_tangent() const {
  return amplitude_.signal() != nullptr || frame_ == Frame::directors ||
         form() == model::Form::multipliers ||
         std::any_of(items_.begin(), items_.end(),
                     [this](const Item& item) { return on_shell(item); });
}

std::vector<int> MomentLoad::blocks(int item, const model::UnknownTable& unknowns) const {
  std::vector<int> result = {unknowns.node_block(items_[static_cast<std::size_t>(item)].node)};
  if (const model::Signal* signal = amplitude_.signal()) {
    result.push_back(unknowns.own_block(signal->block));
  }
  return result;
}

Verdict MomentLoad::assemble(const model::State& state, const Stencil& stencil, Want want,
                             model::Target& target) {
  const double factor = amplitude_.in_step(state, stencil);
  const bool tangent = want == Want::residual_and_tangent;
  Verdict verdict = Verdict::ok;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
    if (on_shell(item)) {
      verdict = worse(
          verdict,
          form() == model::Form::null_space
              ? assemble_director<model::NullSpace>(i, state, stencil, factor, tangent, target)
              : assemble_director<model::FullSpace>(i, state, stencil, factor, tangent, target));
      continue;
    }
    const Motion now = motion(item, state, stencil.theta, factor);
    if (!std::isfinite(now.moment.sum())) return Verdict::not_finite;
    if (form() == model::Form::null_space) {
      assemble_reduced(i, now, stencil.theta, tangent, target);
    } else {
      assemble_full(i, now, stencil.theta, tangent, target);
    }
  }
  return verdict;
}

MomentLoad::Motion MomentLoad::motion(const Item& item, const model::State& state, double theta,
                                      double factor) const {
  Motion motion;
  motion.next = model::NodeTable::slots(state.next, item.node).rightCols<3>();
  motion.mid = (1.0 - theta) * model::NodeTable::slots(state.prev, item.node).rightCols<3>() +
               theta * motion.next;
  motion.components = factor * item.components;
  motion.unit = frame_ == Frame::space ? item.components : Vec3(motion.mid * item.components);
  motion.moment = factor * motion.unit;
  return motion;
}

// r_theta = -m      dr_theta / dtheta = theta sum_k M_k [d_k,next]
void MomentLoad::assemble_reduced(std::size_t i, const Motion& motion, double theta, bool tangent,
                                  model::Target& target) const {
  Vec6 residual;
  residual << Vec3::Zero(), -motion.moment;
  target.force_scale = std::max(target.force_scale, residual.lpNorm<Eigen::Infinity>());
  placement().scatter.add_residual(i, 0, residual.data(), target);
  if (!tangent) return;
  if (const model::Signal* signal = amplitude_.signal()) {
    Vec6 derivative;
    derivative << Vec3::Zero(), -motion.unit;
    model::add_signal_column(placement().scatter, i, 0, 1, *signal, theta, derivative, target);
  }
  if (frame_ == Frame::space) return;
  RowMat<6, 6> block = RowMat<6, 6>::Zero();
  block.bottomRightCorner<3, 3>() = theta * skew(motion.next * motion.components);
  placement().scatter.add_tangent(i, 0, 0, block, target);
}

// r_d_i = -mh x d_i      mh = Ac^-1 m      Ac = sum_i ( |d_i|^2 1 - d_i d_i^T )
// dmh = sum_j G_j dd_j      G_j = Ac^-1 ( M_j 1 - 2 mh d_j^T + (d_j . mh) 1 + d_j mh^T )
// dr_d_i / dd_j = theta ( [d_i] G_j - delta_ij [mh] )
void MomentLoad::assemble_full(std::size_t i, const Motion& motion, double theta, bool tangent,
                               model::Target& target) const {
  const Mat3& d = motion.mid;
  const Mat3 inverse = (d.squaredNorm() * Mat3::Identity() - d * d.transpose()).inverse();
  const Vec3 mh = inverse * motion.moment;
  Vec<12> residual = Vec<12>::Zero();
  for (int k = 0; k < 3; ++k) residual.segment<3>(3 + 3 * k) = -skew(mh) * d.col(k);
  target.force_scale = std::max(target.force_scale, residual.lpNorm<Eigen::Infinity>());
  placement().scatter.add_residual(i, 0, residual.data(), target);
  if (!tangent) return;
  if (const model::Signal* signal = amplitude_.signal()) {
    const Vec3 unit = inverse * motion.unit;
    Vec<12> derivative = Vec<12>::Zero();
    for (int k = 0; k < 3; ++k) derivative.segment<3>(3 + 3 * k) = -skew(unit) * d.col(k);
    model::add_signal_column(placement().scatter, i, 0, 1, *signal, theta, derivative, target);
  }
  RowMat<12, 12> block = RowMat<12, 12>::Zero();
  for (int j = 0; j < 3; ++j) {
    const double follows = frame_ == Frame::directors ? motion.components[j] : 0.0;
    Mat3 G = d.col(j) * mh.transpose() - 2.0 * mh * d.col(j).transpose();
    G.diagonal().array() += follows + d.col(j).dot(mh);
    G = inverse * G.eval();
    for (int k = 0; k < 3; ++k) {
      block.block<3, 3>(3 + 3 * k, 3 + 3 * j) = theta * skew(d.col(k)) * G;
    }
    block.block<3, 3>(3 + 3 * j, 3 + 3 * j) -= theta * skew(mh);
  }
  placement().scatter.add_tangent(i, 0, 0, block, target);
}

template <class Space>
Verdict MomentLoad::assemble_director(std::size_t i, const model::State& state,
                                      const Stencil& stencil, double factor, bool tangent,
                                      model::Target& target) const {
  constexpr int W = Space::width;
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  const NodeMotion motion(nodes_, {item.node}, state, stencil.theta);
  const Vec3 m = -factor * item.components;
  const Vec3 d = motion.mid.col(1);
  Vec<12> r = Vec<12>::Zero();
  r.segment<3>(3) = director_force(m, d);
  if (!std::isfinite(r.sum())) return Verdict::not_finite;
  Vec<W> residual;
  Space::reduce_rows(r, motion.arms_mid[0], residual);
  target.force_scale = std::max(target.force_scale, residual.template lpNorm<Eigen::Infinity>());
  placement().scatter.add_residual(i, 0, residual.data(), target);
  if (!tangent) return Verdict::ok;
  if (const model::Signal* signal = amplitude_.signal()) {
    Vec<12> unit = Vec<12>::Zero();
    unit.segment<3>(3) = director_force(-item.components, d);
    Vec<W> derivative;
    Space::reduce_rows(unit, motion.arms_mid[0], derivative);
    model::add_signal_column(placement().scatter, i, 0, 1, *signal, stencil.theta, derivative,
                             target);
  }
  Mat<12, 12> K = Mat<12, 12>::Zero();
  K.block<3, 3>(3, 3) = stencil.theta * director_derivative(m, d);
  RowMat<W, W> block = RowMat<W, W>::Zero();
  add_slot_tangent<Space>(K, motion.arms_mid[0], motion.arms_next[0], block);
  Space::add_turning(r.reshaped<Eigen::ColMajor>(3, 4), motion.arms_next[0], stencil.theta, block);
  placement().scatter.add_tangent(i, 0, 0, block, target);
  return Verdict::ok;
}

model::StepWork MomentLoad::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  const double factor = amplitude_.in_step(state, stencil);
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
    if (on_shell(item)) {
      const NodeMotion now(nodes_, {item.node}, state, stencil.theta);
      NodeMotion::Slots forces = NodeMotion::Slots::Zero(3, 4);
      forces.col(1) = director_force(factor * item.components, now.mid.col(1));
      add_item_work(forces, now, {item.node}, state, true, work);
      continue;
    }
    const Vec3 moment = motion(item, state, stencil.theta, factor).moment;
    const Mat3 prev = model::NodeTable::slots(state.prev, item.node).rightCols<3>();
    const Mat3 next = model::NodeTable::slots(state.next, item.node).rightCols<3>();
    work.external += moment.dot(cayley_vector(prev, next));
    work.moment += moment;
  }
  return work;
}

}  // namespace culm::load
