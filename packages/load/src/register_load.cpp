#include <culm/load/register_load.hpp>

#include "types.hpp"

namespace culm::load {

void register_loads(model::BuilderRegistry& registry) {
#define CULM_REGISTER(type) register_##type(registry);
  CULM_LOADS(CULM_REGISTER)
#undef CULM_REGISTER
}

}  // namespace culm::load
