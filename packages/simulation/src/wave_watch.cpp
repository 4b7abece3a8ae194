#include "wave_watch.hpp"

#include <culm/water/morison_load.hpp>
#include <culm/water/potential_load.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

namespace culm::simulation {

void WaveWatch::begin(const model::Model& model) {
  surfaces_.clear();
  const auto place_of = [&](int node) -> Vec3 {
    return model::NodeTable::slots(model.nodes().reference(), node).col(0);
  };
  for (const auto& load : model.loads()) {
    if (const auto* morison = dynamic_cast<const water::MorisonLoad*>(load.get())) {
      add(morison->sea(), load->effect(), place_of(morison->first_node()));
    } else if (const auto* body = dynamic_cast<const water::PotentialLoad*>(load.get())) {
      add(body->sea(), load->effect(), place_of(body->node()));
    }
  }
}

void WaveWatch::add(const water::Sea& sea, const model::Effect& effect, const Vec3& place) {
  constexpr double near = 0.05;  // of the length of the waves: the surface is about the same there
  if (sea.waves().empty()) return;
  auto found = std::ranges::find(surfaces_, &sea, &Surface::sea);
  if (found == surfaces_.end()) {
    surfaces_.push_back({&sea, effect.quoted(), {}});
    found = std::prev(surfaces_.end());
  }
  const bool is_known = std::ranges::any_of(found->places, [&](const Vec3& other) {
    return (other - place).norm() < near * sea.main_length();
  });
  if (!is_known) found->places.push_back(place);
}

void WaveWatch::step(const model::State& state) {
  const double time = state.in_motion ? state.time : 0.0;  // statics see the sea at its start
  for (Surface& surface : surfaces_) {
    for (const Vec3& place : surface.places) {
      const double height = surface.sea->elevation(place, time);
      if (std::abs(height) <= std::abs(surface.farthest)) continue;
      surface.farthest = height;
      surface.time = time;
    }
  }
}

void WaveWatch::report(Findings& findings) const {
  for (const Surface& surface : surfaces_) {
    const double breaking = surface.sea->breaking_height();
    if (std::abs(surface.farthest) <= 0.5 * breaking) continue;
    findings.warn(
        "high waves",
        fmt::format("the waves of the sea of {} add up to {:.4g} m {} still water at {:.6g} s, but "
                    "even the longest of them breaks above a height of {:.4g} m, of which half is "
                    "on either side: there is no such sea",
                    surface.load, std::abs(surface.farthest),
                    surface.farthest > 0.0 ? "above" : "below", surface.time, breaking),
        surface.time);
  }
}

void WaveWatch::save(Snapshot& snapshot) const {
  std::vector<double> numbers;
  for (const Surface& surface : surfaces_) {
    numbers.insert(numbers.end(), {surface.farthest, surface.time});
  }
  snapshot.set("run/waves", std::move(numbers));
}

void WaveWatch::restore(const Snapshot& snapshot) {
  const std::span<const double> numbers = snapshot.numbers("run/waves", 2 * surfaces_.size());
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    surfaces_[i].farthest = numbers[2 * i];
    surfaces_[i].time = numbers[2 * i + 1];
  }
}

}  // namespace culm::simulation
