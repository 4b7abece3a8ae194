#include "strip_watch.hpp"

#include <culm/strip/shared_chord.hpp>

namespace culm::simulation {

void StripWatch::begin(const model::Model& model) {
  std::vector<const strip::StripLoad*> strips;
  pairs_.clear();
  for (const auto& load : model.loads()) {
    const auto* strip = dynamic_cast<const strip::StripLoad*>(load.get());
    if (strip == nullptr) continue;
    for (const strip::StripLoad* other : strips) {
      if (strip::share_chord(*other, *strip, model)) pairs_.emplace_back(other, strip);
    }
    strips.push_back(strip);
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
}

}  // namespace culm::simulation
