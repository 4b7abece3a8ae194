#include "held_elements.hpp"

namespace culm::beam {

void register_kirchhoff_elements(ElementFamilies& families) {
  add_director_families(families, {.fidelity = "Kirchhoff"}, "Kirchhoff",
                        []<int Order>(std::integral_constant<int, Order>, const std::string& effect,
                                      const Place& to) {
                          return add_held_elements<KirchhoffBeam<Order>>(effect, to);
                        });
}

}  // namespace culm::beam
