#include "rotating_air.hpp"

#include <culm/model/steady_rotation.hpp>
#include <culm/strip/strip_load.hpp>

#include <algorithm>

namespace culm::simulation {
namespace {

bool stands_in(const strip::StripLoad& strips, const model::SteadyRotation& frame) {
  return std::any_of(strips.stations().begin(), strips.stations().end(), [&](const auto& station) {
    const std::vector<int>& nodes = station.point.nodes;
    return std::any_of(nodes.begin(), nodes.end(), [&](int node) { return frame.turns(node); });
  });
}

}  // namespace

std::vector<std::string> strips_that_miss_rotation(const model::Model& model) {
  std::vector<std::string> sentences;
  for (const auto& load : model.loads()) {
    const auto* frame = dynamic_cast<const model::SteadyRotation*>(load.get());
    if (frame == nullptr) continue;
    for (const auto& other : model.loads()) {
      const auto* strips = dynamic_cast<const strip::StripLoad*>(other.get());
      if (strips == nullptr || !stands_in(*strips, *frame)) continue;
      sentences.push_back(strips->effect().quoted() + " stands in the frame that " +
                          load->effect().quoted() +
                          " turns, and meets the wind as if it stood still: the speed of the frame "
                          "is not in it; for a rotor in operation take a motion in time");
    }
  }
  return sentences;
}

}  // namespace culm::simulation
