#include "director_elements.hpp"

#include <culm/beam/element_batches.hpp>

namespace culm::beam {

void register_director_elements(ElementFamilies& families) {
  add_director_families(
      families, {.fidelity = "Full"}, "director",
      []<int Order>(std::integral_constant<int, Order>, const std::string& effect,
                    const Place& to) { return add_full<DirectorBeam<Order>>(effect, to); });
}

}  // namespace culm::beam
