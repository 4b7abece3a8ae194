#include <culm/load/field_load.hpp>
#include <culm/load/slot_kernel.hpp>

namespace culm::load {
namespace {

using FieldMotion = model::ItemMotion<FieldLoad::max_nodes>;

// T_s of the slots of node a.
Vec<4> factors(const model::Marker& point, std::size_t a) {
  Vec<4> T;
  T << point.weights[a], point.weights[a] * point.offset;
  return T;
}

Vec3 place_of(const model::Marker& point, const FieldMotion::Slots& q) {
  Vec3 place = Vec3::Zero();
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    place += q.middleCols<4>(4 * static_cast<int>(a)) * factors(point, a);
  }
  return place;
}

// T_s f
FieldMotion::Slots slot_forces(const model::Marker& point, const Vec3& force) {
  FieldMotion::Slots forces(3, 4 * static_cast<int>(point.nodes.size()));
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    forces.middleCols<4>(4 * static_cast<int>(a)) = force * factors(point, a).transpose();
  }
  return forces;
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
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  const model::Marker& point = item.point;
  const FieldMotion motion(nodes_, point.nodes, state, stencil.theta);
  const double factor = item.factor * amplitude_.in_step(state, stencil);
  const Vec3 place = place_of(point, motion.mid);
  const double time = time_of(state, stencil);
  const Vec3 force = factor * field_->value(place, time);
  const FieldMotion::Slots r = -slot_forces(point, force);
  const Verdict verdict = add_slot_residual<Space>(placement(), i, r, motion.arms_mid, target);
  if (!tangent || verdict != Verdict::ok) return verdict;

  const Mat3 gradient = -stencil.theta * factor * field_->gradient(place, time);
  const auto by_slots = [&](int a, int b) {
    const Vec<4> T = factors(point, static_cast<std::size_t>(a));
    const Vec<4> other = factors(point, static_cast<std::size_t>(b));
    Mat<12, 12> K;
    for (int s = 0; s < 4; ++s) {
      for (int t = 0; t < 4; ++t) K.block<3, 3>(3 * s, 3 * t) = T[s] * other[t] * gradient;
    }
    return K;
  };
  add_dense_derivative<Space>(placement(), i, r, motion, stencil.theta, by_slots, target);
  return Verdict::ok;
}

model::StepWork FieldLoad::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  const double amplitude = amplitude_.in_step(state, stencil);
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
    const FieldMotion motion(nodes_, item.point.nodes, state, stencil.theta);
    const Vec3 force = item.factor * amplitude *
                       field_->value(place_of(item.point, motion.mid), time_of(state, stencil));
    add_item_work(slot_forces(item.point, force), motion, item.point.nodes, state, true, work);
  }
  return work;
}

}  // namespace culm::load
