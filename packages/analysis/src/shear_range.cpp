#include "shear_range.hpp"

#include <culm/model/layer_source.hpp>
#include <culm/model/shear_source.hpp>
#include <culm/parallel/owned_numbers.hpp>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

namespace culm::analysis {
namespace {

using model::Coordinates;
using States = std::vector<model::LayerState>;

constexpr double notable_error = 0.05;   // of displacements
constexpr std::size_t most_cells = 500;  // of a structure, that are looked at
constexpr std::array<double, 3> simpson{1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};

// Twice the energy, and what of it the shear correction would add.
struct Energy {
  double all = 0.0;
  double missing = 0.0;
};

double area(const model::Cell& cell, const Coordinates& q) {
  const auto at = [&](std::size_t a) {
    return Vec3(model::NodeTable::slots(q, cell.nodes[a]).col(0));
  };
  return 0.5 * (at(2) - at(0)).cross(at(3) - at(1)).norm();
}

// Per area; products of shears and shear stresses along the axes of the wall.
Energy energy_of(const model::ShearSource& wall, const States& states) {
  const std::vector<model::ShearSource::Layer> layers = wall.shear_layers();
  const Vec<2> left_out = wall.left_out();
  Energy energy;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const model::ShearSource::Layer& layer = layers[i / simpson.size()];
    const double weight = layer.thickness * simpson.at(i % simpson.size());
    const Vec6& E = states[i].strain;
    const Vec6& S = states[i].stress;
    const Eigen::Rotation2Dd turn(layer.angle);
    const Vec<2> shears = turn * Vec<2>(E[4], E[3]);
    const Vec<2> stresses = turn * Vec<2>(S[4], S[3]);
    energy.all += weight * E.dot(S);
    energy.missing += weight * left_out.dot(shears.cwiseProduct(stresses));
  }
  return energy;
}

// Largest motion of a node of a structure, from one configuration to another [m].
double motion_of(const model::Structure& structure, const Coordinates& from,
                 const Coordinates& to) {
  double largest = 0.0;
  for (const model::Cell& cell : structure.cells) {
    for (const int node : cell.nodes) {
      const Vec3 moved =
          model::NodeTable::slots(to, node).col(0) - model::NodeTable::slots(from, node).col(0);
      largest = std::max(largest, moved.norm());
    }
  }
  return largest;
}

constexpr double notable_motion = 1e-3;  // of the largest: less is the rest of what another does

// Of the structures together: one that stores next to nothing matters to nobody, nor does one that
// stands still while others move.
// @param states_at(source, cell)
template <class StatesAt>
void compute_share(const assembly::System& system, const Coordinates& from, const Coordinates& q,
                   const StatesAt& states_at, double& share, std::string& most) {
  const model::Model& model = system.model();
  Energy sum;
  double largest = 0.0;
  double furthest = 0.0;
  for (const model::Structure& structure : model.structures()) {
    furthest = std::max(furthest, motion_of(structure, from, q));
  }
  for (const model::Structure& structure : model.structures()) {
    const auto* wall = dynamic_cast<const model::ShearSource*>(structure.layers.get());
    if (wall == nullptr) continue;
    if (motion_of(structure, from, q) < notable_motion * furthest) continue;
    Energy own;
    const std::size_t stride = std::max<std::size_t>(1, structure.cells.size() / most_cells);
    const auto cell_of = [&](int i) { return static_cast<int>(stride) * i; };
    const std::vector<double> energies = parallel::share_owned(
        system.comm(), (structure.cells.size() + stride - 1) / stride, 2,
        [&](int i) { return structure.layers->owns(cell_of(i)); },
        [&](int i, std::vector<double>& numbers) {
          const auto c = static_cast<std::size_t>(cell_of(i));
          const double size = static_cast<double>(stride) * area(structure.cells[c], q);
          const Energy cell = energy_of(*wall, states_at(*structure.layers, cell_of(i)));
          numbers.insert(numbers.end(), {size * cell.all, size * cell.missing});
        });
    for (std::size_t i = 0; i < energies.size(); i += 2) {
      own.all += energies[i];
      own.missing += energies[i + 1];
    }
    if (own.missing > largest) most = structure.name;
    largest = std::max(largest, own.missing);
    sum.all += own.all;
    sum.missing += own.missing;
  }
  share = sum.all > 0.0 ? sum.missing / sum.all : 0.0;
}

bool has_walls(const model::Model& model) {
  return std::ranges::any_of(model.structures(), [](const model::Structure& structure) {
    const auto* wall = dynamic_cast<const model::ShearSource*>(structure.layers.get());
    return wall != nullptr && !wall->left_out().isZero();
  });
}

std::string cure(const std::string& structure) {
  return fmt::format(
      "the wall of '{}' is thick for its waves, or soft in shear. Take 'Shear Correction' = "
      "Equilibrium",
      structure);
}

}  // namespace

void warn_of_shear(Context& context, model::State& state) {
  const model::Model& model = context.system.model();
  if (!has_walls(model)) return;
  context.system.synchronise(state);
  double share = 0.0;
  std::string structure;
  compute_share(
      context.system, model.nodes().reference(), state.next,
      [&](const model::LayerSource& source, int cell) { return source.states(cell, state.next); },
      share, structure);
  if (share < notable_error) return;
  context.findings.warn(
      "thick wall",
      fmt::format(
          "transverse shear takes so much of the energy that displacements are about {:.2g} "
          "% too small without a shear correction: {}",
          100.0 * share, cure(structure)),
      state.time);
}

void warn_of_shear(Context& context, const model::State& state, const ModeSet& set) {
  const model::Model& model = context.system.model();
  if (!has_walls(model)) return;
  for (std::size_t m = 0; m < set.modes.size(); ++m) {
    if (set.modes[m].is_zero()) continue;
    Coordinates forward = state.next;
    Coordinates back = state.next;
    const std::vector<Vec6>& motions = set.modes[m].shape.real;
    for (std::size_t node = 0; node < motions.size(); ++node) {
      const auto number = static_cast<int>(node);
      for (const int slot : {0, 1}) {
        const Vec3 motion = motions[node].segment<3>(3 * slot);
        model::NodeTable::slots(forward, number).col(slot) += motion;
        model::NodeTable::slots(back, number).col(slot) -= motion;
      }
    }
    const auto slopes = [&](const model::LayerSource& source, int cell) {
      States states = source.states(cell, forward);
      const States other = source.states(cell, back);
      for (std::size_t i = 0; i < states.size(); ++i) {
        states[i].strain -= other[i].strain;  // exact, as strains are quadratic
        states[i].stress -= other[i].stress;
      }
      return states;
    };
    double share = 0.0;
    std::string structure;
    compute_share(context.system, state.next, forward, slopes, share, structure);
    if (share < notable_error) continue;
    context.findings.warn(
        "thick wall",
        fmt::format(
            "mode {}: transverse shear takes so much of the energy that its frequency is "
            "about {:.2g} % too high without a shear correction, and those of shorter waves "
            "by more: {}",
            m + 1, 50.0 * share, cure(structure)),
        state.time);
    return;
  }
}

}  // namespace culm::analysis
