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
  const auto stretches = std::make_shared<const Stretches<Beam>>(to);
  return add_series<Beam, Held>(
      to, *stretches,
      {nodes_of_elements<Beam>(to),
       [stretches](const auto& nodes, int k) { return Held(stretches->element(nodes, k)); }},
      batch, [&](int, const Stretch<Beam>& stretch) {
        to.model.add_constraint(hold_strains(to.structure.name, Held::held,
                                             make_element(stretch, to.sections), stretch.nodes,
                                             stretch.slots));
      });
}

}  // namespace culm::beam
