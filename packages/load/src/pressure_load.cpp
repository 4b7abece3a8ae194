#include <culm/load/pressure_load.hpp>
#include <culm/load/slot_kernel.hpp>
#include <culm/math/rotation.hpp>
#include <culm/model/item_motion.hpp>

#include "face_points.hpp"

#include <algorithm>
#include <cmath>

namespace culm::load {
namespace {

using Motion = model::ItemMotion<4>;
using Corners = Mat<3, 4>;

// int N_a g1 x g2 at the corners X
Corners area_vectors(const Corners& X) {
  Corners f = Corners::Zero();
  for (const FacePoint& point : face_points()) {
    const Vec3 normal = (X * point.N_xi).cross(X * point.N_eta);
    f += normal * point.N.transpose();
  }
  return f;
}

// The same on the slots, shape (3, 16).
Motion::Slots slot_forces(const Corners& f, double zeta) {
  Motion::Slots forces = Motion::Slots::Zero(3, 16);
  for (int a = 0; a < 4; ++a) {
    forces.col(4 * a) = f.col(a);
    forces.col(4 * a + 1) = zeta * f.col(a);
  }
  return forces;
}

// d f_a / d X_b = int N_a ([g1] N_b,eta - [g2] N_b,xi), corner blocks, shape (12, 12)
Mat<12, 12> area_derivative(const Corners& X) {
  Mat<12, 12> K = Mat<12, 12>::Zero();
  for (const FacePoint& point : face_points()) {
    const Mat3 along = skew(X * point.N_xi);
    const Mat3 across = skew(X * point.N_eta);
    for (int b = 0; b < 4; ++b) {
      const Mat3 turned = point.N_eta[b] * along - point.N_xi[b] * across;
      for (int a = 0; a < 4; ++a) K.block<3, 3>(3 * a, 3 * b) += point.N[a] * turned;
    }
  }
  return K;
}

// From corners to the slots x, d of both nodes.
Mat<12, 12> slot_block(const Mat3& K, double zeta) {
  Mat<12, 12> block = Mat<12, 12>::Zero();
  block.block<3, 3>(0, 0) = K;
  block.block<3, 3>(0, 3) = block.block<3, 3>(3, 0) = zeta * K;
  block.block<3, 3>(3, 3) = zeta * zeta * K;
  return block;
}

}  // namespace

std::vector<int> PressureLoad::blocks(int item, const model::UnknownTable& unknowns) const {
  return blocks_of(items_[static_cast<std::size_t>(item)].nodes, unknowns);
}

Verdict PressureLoad::assemble(const model::State& state, const Stencil& stencil, Want want,
                               model::Target& target) {
  if (want == Want::mass) return Verdict::ok;
  const double factor = amplitude_.in_step(state, stencil);
  const bool tangent = want == Want::residual_and_tangent;
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, factor, tangent, target);
  });
}

template <class Space>
Verdict PressureLoad::assemble_item(std::size_t i, const model::State& state,
                                    const Stencil& stencil, double factor, bool tangent,
                                    model::Target& target) const {
  constexpr int W = Space::width;
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  const Motion motion(nodes_, item.nodes, state, stencil.theta);
  const Corners X = corners(motion.mid, item.zeta);
  const double p = -factor * item.pressure;
  const Motion::Slots r = slot_forces(p * area_vectors(X), item.zeta);
  if (!std::isfinite(r.sum())) return Verdict::not_finite;
  for (int a = 0; a < 4; ++a) {
    const Eigen::Map<const Vec<12>> slot_residual(r.data() + 12 * a);
    Vec<W> residual;
    Space::reduce_rows(slot_residual, motion.arms_mid[static_cast<std::size_t>(a)], residual);
    target.force_scale = std::max(target.force_scale, residual.template lpNorm<Eigen::Infinity>());
    placement().scatter.add_residual(i, a, residual.data(), target);
  }
  if (!tangent) return Verdict::ok;

  const Mat<12, 12> K = p * stencil.theta * area_derivative(X);
  for (int a = 0; a < 4; ++a) {
    const model::Arms<4>& arms = motion.arms_mid[static_cast<std::size_t>(a)];
    for (int b = 0; b < 4; ++b) {
      RowMat<W, W> block = RowMat<W, W>::Zero();
      const model::Arms<4>& arms_next = motion.arms_next[static_cast<std::size_t>(b)];
      add_slot_tangent<Space>(slot_block(K.block<3, 3>(3 * a, 3 * b), item.zeta), arms, arms_next,
                              block);
      if (a == b) {
        Space::add_turning(r.middleCols<4>(4 * a), arms_next, stencil.theta, block);
      }
      placement().scatter.add_tangent(i, a, b, block, target);
    }
  }
  return Verdict::ok;
}

model::StepWork PressureLoad::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  const double factor = amplitude_.in_step(state, stencil);
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
    const Motion motion(nodes_, item.nodes, state, stencil.theta);
    const Corners f = factor * item.pressure * area_vectors(corners(motion.mid, item.zeta));
    add_item_work(slot_forces(f, item.zeta), motion, item.nodes, state, true, work);
  }
  return work;
}

}  // namespace culm::load
