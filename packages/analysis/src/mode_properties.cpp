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

ModeProperties ModeMasses::properties(const Shape& shape) const {
  ModeProperties result;
  result.energy.assign(model_.structures().size(), 0.0);
  std::vector<double> displacement(shape.real.size(), 0.0);  // squares, per node
  double rotation = 0.0;
  double mass = 0.0;
  for (const std::vector<Vec6>* part : {&shape.real, &shape.imaginary}) {
    if (part->empty()) continue;
    const Coordinates slots = slot_motions(model_, state_, *part);
    const Coordinates inertia = model_.mass_times(slots);
    mass += dot(slots, inertia);
    for (int i = 0; i < 6; ++i) {
      const double projected = dot(slots, rigid_[static_cast<std::size_t>(i)]);
      result.participation[i] =
          shape.imaginary.empty() ? projected : std::hypot(result.participation[i], projected);
    }
    for (std::size_t node = 0; node < part->size(); ++node) {
      displacement[node] += (*part)[node].head<3>().squaredNorm();
      rotation = std::max(rotation, (*part)[node].tail<3>().norm());
    }
    for (std::size_t s = 0; s < result.energy.size(); ++s) {
      for (int node : model_.structures()[s].nodes) {
        result.energy[s] +=
            NodeTable::slots(slots, node).cwiseProduct(NodeTable::slots(inertia, node)).sum();
      }
    }
  }
  const double largest = std::sqrt(*std::max_element(displacement.begin(), displacement.end()));
  // a motion that only turns displaces nothing but by rounding
  if (largest > 1e-9 * rotation * model_.length()) result.modal_mass = mass / (largest * largest);
  const double sum = std::accumulate(result.energy.begin(), result.energy.end(), 0.0);
  for (double& energy : result.energy) energy /= sum;
  return result;
}

double modal_assurance(const model::Model& model, const model::State& state, const Shape& one,
                       const Shape& other) {
  const auto slots = [&](const std::vector<Vec6>& part) {
    return part.empty() ? Coordinates(state.next.size(), 0.0) : slot_motions(model, state, part);
  };
  const Coordinates a[2] = {slots(one.real), slots(one.imaginary)};
  const Coordinates b[2] = {slots(other.real), slots(other.imaginary)};
  const Coordinates Ma[2] = {model.mass_times(a[0]), model.mass_times(a[1])};
  const Coordinates Mb[2] = {model.mass_times(b[0]), model.mass_times(b[1])};
  const double real = dot(Ma[0], b[0]) + dot(Ma[1], b[1]);
  const double imaginary = dot(Ma[0], b[1]) - dot(Ma[1], b[0]);
  const double squares =
      (dot(Ma[0], a[0]) + dot(Ma[1], a[1])) * (dot(Mb[0], b[0]) + dot(Mb[1], b[1]));
  return (real * real + imaginary * imaginary) / squares;
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
