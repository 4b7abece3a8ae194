#include "director_elements.hpp"

namespace culm::beam {

void register_rigid_elements(ElementFamilies& families) {
  add_director_families(
      families, {.fidelity = "Rigid"}, "rigid",
      []<int Order>(std::integral_constant<int, Order>, const std::string&, const Place& to) {
        return add_rigid<DirectorBeam<Order>>(to);
      });
}

}  // namespace culm::beam
