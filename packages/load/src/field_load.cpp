#include <culm/load/field_load.hpp>
#include <culm/load/slot_kernel.hpp>

#include <algorithm>
#include <cmath>

namespace culm::load {
namespace {

using Motion = model::ItemMotion<FieldLoad::max_nodes>;

// T_s of the slots of node a.
Vec<4> factors(const model::Marker& point, std::size_t a) {
  Vec<4> T;
  T << point.weights[a], point.weights[a] * point.offset;
  return T;
}

Vec3 place_of(const model::Marker& point, const Motion::Slots& q) {
  Vec3 place = Vec3::Zero();
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    place += q.middleCols<4>(4 * static_cast<int>(a)) * factors(point, a);
  }
  return place;
}

double time_of(const model::State& state, const Stencil& stencil) {
  return (1.0 - stencil.theta) * state.time_prev + stencil.theta * state.time;
}

}  // namespace

std::vector<int> FieldLoad::blocks(int item, const model::UnknownTable& unknowns) const {
  return blocks_of(items_[static_cast<std::size_t>(item)].point.nodes, unknowns);
}

Verdict FieldLoad::assemble(const model::State& state, const Stencil& stencil, Want want,
                            model::Target& target) {
  if (want == Want::mass) return Verdict::ok;
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, want == Want::residual_and_tangent,
                                          target);
  });
}

// r_s = -T_s f      dr_s / dq_t = -theta T_s T_t df/dx
template <class Space>
Verdict FieldLoad::assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                                 bool tangent, model::Target& target) const {
  constexpr int W = Space::width;
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  const model::Marker& point = item.point;
  const Motion motion(nodes_, point.nodes, state, stencil.theta);
  const double factor = item.factor * amplitude_.in_step(state, stencil);
  const Vec3 place = place_of(point, motion.mid);
  const double time = time_of(state, stencil);
  const Vec3 force = factor * field_->value(place, time);
  if (!std::isfinite(force.sum())) return Verdict::not_finite;
  Mat3 gradient = Mat3::Zero();
  if (tangent) gradient = -stencil.theta * factor * field_->gradient(place, time);
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    const Vec<4> T = factors(point, a);
    const Vec<12> slots = Mat<3, 4>(-force * T.transpose()).reshaped();
    Vec<W> residual;
    Space::reduce_rows(slots, motion.arms_mid[a], residual);
    target.force_scale = std::max(target.force_scale, residual.template lpNorm<Eigen::Infinity>());
    placement().scatter.add_residual(i, static_cast<int>(a), residual.data(), target);
    if (!tangent) continue;
    for (std::size_t b = 0; b < point.nodes.size(); ++b) {
      const Vec<4> other = factors(point, b);
      Mat<12, 12> K;
      for (int s = 0; s < 4; ++s) {
        for (int t = 0; t < 4; ++t) K.block<3, 3>(3 * s, 3 * t) = T[s] * other[t] * gradient;
      }
      RowMat<W, W> block = RowMat<W, W>::Zero();
      add_slot_tangent<Space>(K, motion.arms_mid[a], motion.arms_next[b], block);
      if (a == b) {
        Space::add_turning(slots.reshaped<Eigen::ColMajor>(3, 4), motion.arms_next[a],
                           stencil.theta, block);
      }
      placement().scatter.add_tangent(i, static_cast<int>(a), static_cast<int>(b), block, target);
    }
  }
  return Verdict::ok;
}

model::StepWork FieldLoad::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  const double amplitude = amplitude_.in_step(state, stencil);
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
    const Motion motion(nodes_, item.point.nodes, state, stencil.theta);
    const Vec3 force = item.factor * amplitude *
                       field_->value(place_of(item.point, motion.mid), time_of(state, stencil));
    Motion::Slots forces(3, motion.mid.cols());
    for (std::size_t a = 0; a < item.point.nodes.size(); ++a) {
      forces.middleCols<4>(4 * static_cast<int>(a)) = force * factors(item.point, a).transpose();
    }
    add_item_work(forces, motion, item.point.nodes, state, true, work);
  }
  return work;
}

}  // namespace culm::load
