#include "types.hpp"

namespace culm::flow {

void register_flows(FlowRegistry& registry) { register_uniform(registry); }

}  // namespace culm::flow
