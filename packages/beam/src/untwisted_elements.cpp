#include "held_elements.hpp"

namespace culm::beam {

void register_untwisted_elements(ElementFamilies& families) {
  add_director_families(families, {.fidelity = "Full", .twists = false}, "director without torsion",
                        []<int Order>(std::integral_constant<int, Order>, const std::string& effect,
                                      const Place& to) {
                          return add_held_elements<UntwistedBeam<Order>>(effect, to);
                        });
}

}  // namespace culm::beam
