/// Elements along an axis with strains held by constraints.
#pragma once

#include <culm/beam/held_beam.hpp>
#include <culm/model/element_batch.hpp>

#include "element_chain.hpp"

namespace culm::beam {

template <class Held>
ReferenceState add_held_elements(const std::string& effect, const Place& to) {
  using Beam = typename Held::Base;
  auto& batch = model::elements<Held>(to.model, effect,
                                      to.damping.of_strains(Held::first_strain, Held::num_strains));
  return add_all<Beam>(to.chain, to.nodes, to.sections, to.structure,
                       [&](const Beam& element, const Stretch<Beam>& stretch) {
                         to.model.add_constraint(hold_strains(
                             to.structure.name, Held::held, element, stretch.nodes, stretch.slots));
                         return Source{&batch, batch.add(Held(element), stretch.nodes)};
                       });
}

}  // namespace culm::beam
