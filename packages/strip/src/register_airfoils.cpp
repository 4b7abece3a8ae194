#include "types.hpp"

namespace culm::strip {

void register_airfoils(AirfoilRegistry& registry) {
#define CULM_REGISTER(type) register_##type(registry);
  CULM_AIRFOILS(CULM_REGISTER)
#undef CULM_REGISTER
}

}  // namespace culm::strip
