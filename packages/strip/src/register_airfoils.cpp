#include "types.hpp"

namespace culm::strip {

void register_airfoils(AirfoilRegistry& registry) {
  register_thin(registry);
  register_polar(registry);
}

}  // namespace culm::strip
