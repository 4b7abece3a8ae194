#include <culm/beam/element_batches.hpp>
#include <culm/beam/helical_beam.hpp>

#include "element_chain.hpp"

namespace culm::beam {

HelicalBeam make_element(const Stretch<HelicalBeam>& stretch, const SectionTable& sections) {
  return {stretch.slots, stretch.section_at(sections, 0.0).stiffness, stretch.masses<2>(sections)};
}

double jacobian(const Stretch<HelicalBeam>& stretch, const SectionTable& sections, double) {
  return 0.5 * make_element(stretch, sections).length();
}

void register_helical_elements(ElementFamilies& families) {
  ElementFamily family{.element = "Helical", .order = 1, .fidelity = "Full"};
  family.damps_strains = false;
  family.most_turn = HelicalBeam::max_rotation;
  family.add = [](const Place& to) {
    return add_full<HelicalBeam>("Beam, helical", to, [](auto&&...) {});
  };
  families.add(family);
  family.fidelity = "Rigid";
  family.most_turn = std::numeric_limits<double>::infinity();
  family.add = [](const Place& to) { return add_rigid<HelicalBeam>(to); };
  families.add(family);
}

}  // namespace culm::beam
