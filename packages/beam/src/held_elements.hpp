/// Elements along an axis with strains held by constraints.
#pragma once

#include <culm/beam/held_beam.hpp>

#include "director_elements.hpp"

namespace culm::beam {

template <class Held>
double add_held_elements(const std::string& effect, const Place& to) {
  using Beam = typename Held::Base;
  auto& batch = model::elements<Held>(to.model, effect,
                                      to.damping.of_strains(Held::first_strain, Held::num_strains));
  return add_all<Beam>(to, [&](const Beam& element, const Stretch<Beam>& stretch) {
    to.model.add_constraint(
        hold_strains(to.structure.name, Held::held, element, stretch.nodes, stretch.slots));
    const int item = batch.add(Held(element), stretch.nodes);
    set_expansion(batch, item, stretch, to.sections);
    return Source{&batch, item};
  });
}

}  // namespace culm::beam
