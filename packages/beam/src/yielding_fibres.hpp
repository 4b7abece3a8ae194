/// Fibres of beam sections that yield.
#pragma once

#include <culm/structure/plastic_batch.hpp>

#include "element_chain.hpp"

namespace culm::beam {

/// What yields in an element of which `stretch` is the place; shear and twist stay elastic.
/// @param beam  the element itself, or the one that it is made of
template <class Element, class Beam>
structure::YieldingElement<Element, material::UniaxialPlasticity> yielding_element(
    int item, const Beam& beam, const Stretch<Beam>& stretch, const SectionTable& sections) {
  structure::YieldingElement<Element, material::UniaxialPlasticity> yielding;
  yielding.item = item;
  const auto rule = gauss_legendre(Element::num_points);
  for (std::size_t p = 0; p < rule.size(); ++p) {
    const material::Section section = stretch.section_at(sections, rule[p].xi);
    for (const material::Fibre& fibre : section.fibres) {
      structure::MaterialPoint<Element, material::UniaxialPlasticity> place;
      // stretched by Γ3 + K1 xi2 - K2 xi1
      place.map << 0.0, 0.0, 1.0, fibre.place[1], -fibre.place[0], 0.0;
      place.weight = beam.length(static_cast<int>(p)) * fibre.area;
      place.law = section.plasticity;
      place.resultants = fibre.area / Element::num_points * place.map.transpose();
      yielding.places[p].push_back(place);
    }
  }
  return yielding;
}

/// Lets an element that was added to its batch yield, if its sections do.
template <class Element, class Beam>
void add_yielding(model::ElementBatch<Element>& batch, int item, const Stretch<Beam>& stretch,
                  const Place& to) {
  if (!to.sections.yields()) return;
  const Beam beam = make_element(stretch, to.sections);
  structure::plastic_flow<material::UniaxialPlasticity>(to.model, to.structure.name, batch)
      .add(yielding_element<Element>(item, beam, stretch, to.sections));
}

}  // namespace culm::beam
