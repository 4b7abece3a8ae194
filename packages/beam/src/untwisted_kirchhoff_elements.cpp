#include "held_elements.hpp"

namespace culm::beam {

void register_untwisted_kirchhoff_elements(ElementFamilies& families) {
  add_director_families(families, {.fidelity = "Kirchhoff", .twists = false},
                        "Kirchhoff without torsion",
                        []<int Order>(std::integral_constant<int, Order>, const std::string& effect,
                                      const Place& to) {
                          return add_held_elements<UntwistedKirchhoffBeam<Order>>(effect, to);
                        });
}

}  // namespace culm::beam
