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

}  // namespace

void StripWatch::begin(const model::Model& model) {
  std::vector<const strip::StripLoad*> strips;
  pairs_.clear();
  below_ground_.clear();
  for (const auto& load : model.loads()) {
    const auto* lattice = dynamic_cast<const lattice::LatticeLoad*>(load.get());
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
