#include "strip_watch.hpp"

#include <culm/lattice/lattice_load.hpp>
#include <culm/strip/shared_chord.hpp>

#include <algorithm>

namespace culm::simulation {
namespace {

Vec3 place_of(const model::Marker& point, const model::Coordinates& q) {
  Vec3 place = Vec3::Zero();
  for (std::size_t i = 0; i < point.nodes.size(); ++i) {
    place += point.weights[i] * model::NodeTable::slots(q, point.nodes[i]).col(0);
  }
  return place;
}

// In the reference.
bool is_below_ground(const lattice::LatticeLoad& load, const model::Model& model) {
  const lattice::Points points = load.grid(model.nodes().reference());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (load.lattice().flow().is_above_ground(points.at(i))) return false;
  }
  return true;
}
bool is_below_ground(const strip::StripLoad& load, const model::Model& model) {
  return std::ranges::none_of(load.stations(), [&](const strip::Station& station) {
    return load.flow().is_above_ground(place_of(station.point, model.nodes().reference()));
  });
}

// Nodes that carry what lifts there; of a load that only drags, none.
std::vector<int> lifted_nodes(const model::Batch& load) {
  if (const auto* lattice = dynamic_cast<const lattice::LatticeLoad*>(&load)) {
    return lattice->nodes();
  }
  const auto* strip = dynamic_cast<const strip::StripLoad*>(&load);
  std::vector<int> nodes;
  if (strip == nullptr || load.effect().type != "Strip") return nodes;
  for (const strip::Station& station : strip->stations()) {
    nodes.insert(nodes.end(), station.point.nodes.begin(), station.point.nodes.end());
  }
  return nodes;
}

// Whether all nodes that one load lifts are among those of the other one.
bool share_nodes(const model::Batch& one, const model::Batch& other) {
  const auto sorted_nodes = [](const model::Batch& load) {
    std::vector<int> nodes = lifted_nodes(load);
    std::ranges::sort(nodes);
    const auto rest = std::ranges::unique(nodes);
    nodes.erase(rest.begin(), rest.end());
    return nodes;
  };
  const std::vector<int> first = sorted_nodes(one), second = sorted_nodes(other);
  if (first.empty() || second.empty()) return false;
  return std::ranges::includes(first, second) || std::ranges::includes(second, first);
}

}  // namespace

void StripWatch::begin(const model::Model& model) {
  std::vector<const strip::StripLoad*> strips;
  pairs_.clear();
  below_ground_.clear();
  same_nodes_.clear();
  std::vector<const model::Batch*> lifting;
  for (const auto& load : model.loads()) {
    const auto* lattice = dynamic_cast<const lattice::LatticeLoad*>(load.get());
    if (lattice != nullptr || dynamic_cast<const strip::StripLoad*>(load.get()) != nullptr) {
      for (const model::Batch* other : lifting) {
        const bool are_strips =
            lattice == nullptr && dynamic_cast<const strip::StripLoad*>(other) != nullptr;
        if (!are_strips && share_nodes(*load, *other)) same_nodes_.emplace_back(other, load.get());
      }
      lifting.push_back(load.get());
    }
    if (lattice != nullptr && is_below_ground(*lattice, model)) below_ground_.push_back(lattice);
    const auto* strip = dynamic_cast<const strip::StripLoad*>(load.get());
    if (strip == nullptr) continue;
    for (const strip::StripLoad* other : strips) {
      if (strip::share_chord(*other, *strip, model)) pairs_.emplace_back(other, strip);
    }
    strips.push_back(strip);
    if (is_below_ground(*strip, model)) below_ground_.push_back(strip);
  }
}

void StripWatch::step(const model::State& state, Findings& findings) const {
  for (const auto& [one, other] : pairs_) {
    if (!strip::count_twice(*one, *other, state, Stencil::statics())) continue;
    findings.warn("air twice",
                  one->effect().quoted() + " and " + other->effect().quoted() +
                      " lie in the same place and act at the same time, by their functions with "
                      "more than the whole air together: it acts on the structure twice",
                  state.time);
  }
  for (const auto& [one, other] : same_nodes_) {
    findings.warn(
        "air twice",
        one->effect().quoted() + " and " + other->effect().quoted() +
            " lift the same nodes: where they are one wing, the air acts on it twice, and "
            "where they are several, their wakes do not feel each other; name all "
            "surfaces in one load",
        state.time);
  }
  for (const model::Batch* load : below_ground_) {
    findings.warn("below ground",
                  load->effect().quoted() +
                      " meets no wind: all of it stands at the ground of its flow or below, where "
                      "the height along 'Up' above the origin is 0; put the structure higher, or "
                      "take a 'Uniform' flow",
                  state.time);
  }
}

}  // namespace culm::simulation
