#include <culm/load/pressure_load.hpp>
#include <culm/load/slot_kernel.hpp>
#include <culm/math/rotation.hpp>

#include "face_points.hpp"

namespace culm::load {
namespace {

using PressureMotion = model::ItemMotion<4>;
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
PressureMotion::Slots slot_forces(const Corners& f, double zeta) {
  PressureMotion::Slots forces = PressureMotion::Slots::Zero(3, 16);
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
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  const PressureMotion motion(nodes_, item.nodes, state, stencil.theta);
  const Corners X = corners(motion.mid, item.zeta);
  const double p = -factor * item.pressure;
  const PressureMotion::Slots r = slot_forces(p * area_vectors(X), item.zeta);
  const Verdict verdict = add_slot_residual<Space>(placement(), i, r, motion.arms_mid, target);
  if (!tangent || verdict != Verdict::ok) return verdict;

  const Mat<12, 12> K = p * stencil.theta * area_derivative(X);
  add_dense_derivative<Space>(
      placement(), i, r, motion, stencil.theta,
      [&](int a, int b) { return slot_block(K.block<3, 3>(3 * a, 3 * b), item.zeta); }, target);
  return Verdict::ok;
}

model::StepWork PressureLoad::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  const double factor = amplitude_.in_step(state, stencil);
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
    const PressureMotion motion(nodes_, item.nodes, state, stencil.theta);
    const Corners f = factor * item.pressure * area_vectors(corners(motion.mid, item.zeta));
    add_item_work(slot_forces(f, item.zeta), motion, item.nodes, state, true, work);
  }
  return work;
}

}  // namespace culm::load
