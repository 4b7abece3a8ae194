#include "types.hpp"

namespace culm::flow {

void register_flows(FlowRegistry& registry) {
#define CULM_REGISTER(type) register_##type(registry);
  CULM_FLOWS(CULM_REGISTER)
#undef CULM_REGISTER
}

}  // namespace culm::flow
