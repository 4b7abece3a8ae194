#include <culm/base/error.hpp>
#include <culm/load/couple.hpp>
#include <culm/load/slot_kernel.hpp>
#include <culm/port/point_motion.hpp>
#include <culm/port/port_load.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace culm::port {
namespace {

using Slots = model::BoundedSlots<PortLoad::max_nodes>;
constexpr int max_coordinates = 12 * PortLoad::max_nodes;
using SlotTangent = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor,
                                  max_coordinates, max_coordinates>;

// sum_a N_a d_k,a at the slots of an item
Mat3 directors_at(const model::Marker& point, const Slots& slots) {
  Mat3 d = Mat3::Zero();
  for (std::size_t a = 0; a < point.weights.size(); ++a) {
    d += point.weights[a] * slots.middleCols<3>(4 * static_cast<int>(a) + 1);
  }
  return d;
}

// K -= theta N_a N_b df/dd for the pairs of nodes (a, b)
void add_couple_tangent(const model::Marker& point, const Mat<9, 9>& derivative, double theta,
                        SlotTangent& K) {
  for (std::size_t a = 0; a < point.weights.size(); ++a) {
    for (std::size_t b = 0; b < point.weights.size(); ++b) {
      K.block<9, 9>(12 * static_cast<int>(a) + 3, 12 * static_cast<int>(b) + 3) -=
          theta * point.weights[a] * point.weights[b] * derivative;
    }
  }
}

}  // namespace

PortLoad::PortLoad(model::Effect effect, const model::NodeTable& nodes,
                   std::vector<model::Marker> points)
    : MemorylessBatch(std::move(effect)),
      nodes_(nodes),
      points_(std::move(points)),
      moments_(points_.size(), Vec3::Zero()) {
  std::map<std::vector<int>, std::size_t> places;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const std::vector<int>& on = points_[p].nodes;
    internal_check(on.size() <= max_nodes,
                   "a point lies between more nodes than ports provide for");
    const auto [place, is_new] = places.emplace(on, items_.size());
    if (is_new) {
      Item& item = items_.emplace_back();
      item.nodes = on;
      item.kind = kind_of(points_[p], nodes);
      item.forces.setZero(3, 4 * static_cast<int>(on.size()));
    }
    items_[place->second].points.push_back(p);
  }
}

void PortLoad::set(std::span<const Vec3> forces, std::span<const Vec3> moments) {
  internal_check(forces.size() == points_.size() && moments.size() == points_.size(),
                 "a port got loads for another number of points");
  std::copy(moments.begin(), moments.end(), moments_.begin());
  for (Item& item : items_) {
    item.forces.setZero();
    item.has_moments = false;
    for (const std::size_t p : item.points) {
      const model::Marker& point = points_[p];
      const model::NodeSlots whole =
          forces[p] * Vec<4>(1.0, point.offset[0], point.offset[1], point.offset[2]).transpose();
      for (std::size_t a = 0; a < item.nodes.size(); ++a) {
        item.forces.middleCols<4>(4 * static_cast<int>(a)) += point.weights[a] * whole;
      }
      item.has_moments |= !moments_[p].isZero(0.0);
    }
    item.is_loaded = item.has_moments || !item.forces.isZero(0.0);
  }
}

std::vector<int> PortLoad::blocks(int item, const model::UnknownTable& unknowns) const {
  return blocks_of(items_[static_cast<std::size_t>(item)].nodes, unknowns);
}

PortLoad::SlotForces PortLoad::slot_forces(const Item& item, const Motion& motion) const {
  SlotForces f = item.forces;
  if (!item.has_moments) return f;
  for (const std::size_t p : item.points) {
    if (moments_[p].isZero(0.0)) continue;
    const model::Marker& point = points_[p];
    const Mat3 couple =
        load::Couple(directors_at(point, motion.mid), item.kind).forces(moments_[p]);
    for (std::size_t a = 0; a < item.nodes.size(); ++a) {
      f.middleCols<3>(4 * static_cast<int>(a) + 1) += point.weights[a] * couple;
    }
  }
  return f;
}

Verdict PortLoad::assemble(const model::State& state, const Stencil& stencil, Want want,
                           model::Target& target) {
  if (want == Want::mass) return Verdict::ok;
  const bool tangent = want == Want::residual_and_tangent;
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, tangent, target);
  });
}

template <class Space>
Verdict PortLoad::assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                                bool tangent, model::Target& target) const {
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  if (!item.is_loaded) return Verdict::ok;
  const int n = static_cast<int>(item.nodes.size());
  const Motion motion(nodes_, item.nodes, state, stencil.theta);
  const SlotForces r = -slot_forces(item, motion);
  const Verdict verdict =
      load::add_slot_residual<Space>(placement(), i, r, motion.arms_mid, target);
  if (!tangent || verdict != Verdict::ok) return verdict;

  // P_theta^T K P_next of the moments
  SlotTangent K = SlotTangent::Zero(12 * n, 12 * n);
  for (const std::size_t p : item.points) {
    if (moments_[p].isZero(0.0)) continue;
    const load::Couple couple(directors_at(points_[p], motion.mid), item.kind);
    add_couple_tangent(points_[p], couple.derivative(moments_[p]), stencil.theta, K);
  }
  const auto add_block = [&](int a, int b, auto& block) {
    if (!item.has_moments) return;
    load::add_slot_tangent<Space>(K.block<12, 12>(12 * a, 12 * b),
                                  motion.arms_mid[static_cast<std::size_t>(a)],
                                  motion.arms_next[static_cast<std::size_t>(b)], block);
  };
  load::add_slot_derivative<Space>(placement(), i, r, motion, stencil.theta, add_block, target);
  return Verdict::ok;
}

model::StepWork PortLoad::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
    if (!placement().owned[i] || !item.is_loaded) continue;
    const Motion motion(nodes_, item.nodes, state, stencil.theta);
    load::add_item_work(slot_forces(item, motion), motion, item.nodes, state, true, work);
  }
  return work;
}

}  // namespace culm::port
