#include <culm/analysis/mode_properties.hpp>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace culm::analysis {
namespace {

using model::Coordinates;
using model::NodeTable;

double dot(const Coordinates& a, const Coordinates& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

// The motion of all slots with v + omega x (p - centre).
Coordinates rigid_motion(const model::Model& model, const Coordinates& q, const Vec3& v,
                         const Vec3& omega, const Vec3& centre) {
  Coordinates motion(q.size(), 0.0);
  for (int node = 0; node < model.nodes().size(); ++node) {
    const auto from = NodeTable::slots(q, node);
    auto to = NodeTable::slots(motion, node);
    to.col(0) = v + omega.cross(Vec3(from.col(0)) - centre);
    for (int i = 1; i < 4; ++i) to.col(i) = omega.cross(Vec3(from.col(i)));
  }
  return motion;
}

}  // namespace

ModeMasses::ModeMasses(const model::Model& model, const model::State& state)
    : model_(model), state_(state) {
  model::MassProperties all;
  for (const auto& one : model::mass_properties(model, state.next)) all += one;
  const Vec3 centre = all.mass > 0.0 ? all.centre() : Vec3(Vec3::Zero());
  for (int i = 0; i < 6; ++i) {
    Vec6 motion = Vec6::Zero();
    motion[i] = 1.0;
    const Coordinates rigid =
        rigid_motion(model, state.next, motion.head<3>(), motion.tail<3>(), centre);
    rigid_.push_back(model.mass_times(rigid));
    total_[i] = dot(rigid, rigid_.back());
  }
}

ModeProperties ModeMasses::properties(const std::vector<Vec6>& motions) const {
  ModeProperties result;
  const Coordinates slots = slot_motions(model_, state_, motions);
  const Coordinates inertia = model_.mass_times(slots);
  for (int i = 0; i < 6; ++i)
    result.participation[i] = dot(slots, rigid_[static_cast<std::size_t>(i)]);
  double displacement = 0.0;
  double rotation = 0.0;
  for (const Vec6& motion : motions) {
    displacement = std::max(displacement, motion.head<3>().norm());
    rotation = std::max(rotation, motion.tail<3>().norm());
  }
  // a motion that only turns displaces nothing but by rounding
  if (displacement > 1e-9 * rotation * model_.length()) {
    result.modal_mass = dot(slots, inertia) / (displacement * displacement);
  }
  double sum = 0.0;
  for (const model::Structure& structure : model_.structures()) {
    double energy = 0.0;
    for (int node : structure.nodes) {
      energy += NodeTable::slots(slots, node).cwiseProduct(NodeTable::slots(inertia, node)).sum();
    }
    result.energy.push_back(energy);
    sum += energy;
  }
  for (double& energy : result.energy) energy /= sum;
  return result;
}

std::string describe_shares(const model::Model& model, const std::vector<double>& shares) {
  constexpr std::size_t shown = 3;
  constexpr double notable = 0.05;
  std::vector<std::size_t> order(shares.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::lround(1e3 * shares[a]) > std::lround(1e3 * shares[b]);
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, order.size()); ++i) {
    const double share = shares[order[i]];
    if (i > 0 && share < notable) break;
    text += fmt::format("{}{} {:.0f} %", i > 0 ? ", " : "", model.structures()[order[i]].name,
                        100.0 * share);
  }
  return text;
}

}  // namespace culm::analysis
