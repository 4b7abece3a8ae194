/// What loads on slots share, for any number of nodes: from forces on slots to the residual, from
/// their derivative to the tangent, and the work that they do.
#pragma once

#include <culm/model/batch.hpp>
#include <culm/model/item_motion.hpp>
#include <culm/model/signal_column.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace culm::load {

/// block += P_theta^T K P_next for the derivative K of the slot forces of one node by the slots of
/// another, shape (12, 12).
template <class Space, class Block>
void add_slot_tangent(const Mat<12, 12>& K, const model::Arms<4>& arms_mid,
                      const model::Arms<4>& arms_next, Block& block) {
  Mat<Space::width, 12> rows;
  Space::reduce_rows(K, arms_mid, rows);
  const Mat<12, Space::width> columns = rows.transpose();
  Mat<Space::width, Space::width> reduced;
  Space::reduce_rows(columns, arms_next, reduced);
  block += reduced.transpose();
}

/// Adds the residual r of the slots of local item i, shape (3, 4 n), at theta: minus external
/// forces there.
template <class Space, class Slots, std::size_t N>
Verdict add_slot_residual(const model::Placement& placement, std::size_t i, const Slots& r,
                          const std::array<model::Arms<4>, N>& arms_mid, model::Target& target) {
  if (!std::isfinite(r.sum())) return Verdict::not_finite;
  for (int a = 0; 4 * a < r.cols(); ++a) {
    const Eigen::Map<const Vec<12>> of_node(r.data() + 12 * a);
    Vec<Space::width> residual;
    Space::reduce_rows(of_node, arms_mid[static_cast<std::size_t>(a)], residual);
    target.force_scale = std::max(target.force_scale, residual.template lpNorm<Eigen::Infinity>());
    placement.scatter.add_residual(i, a, residual.data(), target);
  }
  return Verdict::ok;
}

/// Adds the derivative of such a residual by the motion of its nodes: add_block(a, b, block) adds
/// P_theta^T K P_next for the slots of node a by those of node b, zero before; the turning of
/// P_theta under r follows here.
template <class Space, class Motion, class Slots, class AddBlock>
void add_slot_derivative(const model::Placement& placement, std::size_t i, const Slots& r,
                         const Motion& motion, double theta, AddBlock add_block,
                         model::Target& target) {
  constexpr int W = Space::width;
  const int n = static_cast<int>(r.cols()) / 4;
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) {
      RowMat<W, W> block = RowMat<W, W>::Zero();
      add_block(a, b, block);
      if (a == b) {
        Space::add_turning(r.template middleCols<4>(4 * a),
                           motion.arms_next[static_cast<std::size_t>(a)], theta, block);
      }
      placement.scatter.add_tangent(i, a, b, block, target);
    }
  }
}

/// The same where the derivative of the slots of node a by those of node b is at hand, K(a, b) of
/// shape (12, 12).
template <class Space, class Motion, class Slots, class Derivative>
void add_dense_derivative(const model::Placement& placement, std::size_t i, const Slots& r,
                          const Motion& motion, double theta, Derivative K, model::Target& target) {
  add_slot_derivative<Space>(
      placement, i, r, motion, theta,
      [&](int a, int b, auto& block) {
        add_slot_tangent<Space>(K(a, b), motion.arms_mid[static_cast<std::size_t>(a)],
                                motion.arms_next[static_cast<std::size_t>(b)], block);
      },
      target);
}

/// Adds the derivative of a residual by the signal that it follows. @param unit  by its value; the
/// block of the signal comes after those of the nodes
template <class Space, class Slots, std::size_t N>
void add_signal_columns(const model::Placement& placement, std::size_t i, const Slots& unit,
                        const std::array<model::Arms<4>, N>& arms_mid, const model::Signal& signal,
                        double theta, model::Target& target) {
  const int n = static_cast<int>(unit.cols()) / 4;
  for (int a = 0; a < n; ++a) {
    const Eigen::Map<const Vec<12>> of_node(unit.data() + 12 * a);
    Vec<Space::width> derivative;
    Space::reduce_rows(of_node, arms_mid[static_cast<std::size_t>(a)], derivative);
    model::add_signal_column(placement.scatter, i, a, n, signal, theta, derivative, target);
  }
}

/// The time at which the loads of a step are taken [s].
inline double time_of(const model::State& state, const Stencil& stencil) {
  return (1.0 - stencil.theta) * state.time_prev + stencil.theta * state.time;
}

/// Adds what the external slot forces of an item do in a step; their work only if `works`.
template <class Motion, class Forces>
void add_item_work(const Forces& forces, const Motion& motion, const std::vector<int>& nodes,
                   const model::State& state, bool works, model::StepWork& work) {
  for (int s = 0; s < forces.cols(); ++s) {
    const int node = nodes[static_cast<std::size_t>(s / 4)];
    const Vec3 f = forces.col(s);
    const Vec3 moved = motion.next.col(s) - model::NodeTable::slots(state.prev, node).col(s % 4);
    if (works) work.external += moved.dot(f);
    if (s % 4 == 0) work.force += f;
    work.moment += Vec3(motion.mid.col(s)).cross(f);
  }
}

}  // namespace culm::load
