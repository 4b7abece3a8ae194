/// The type 'Potential Flow' of the list Loads.
#pragma once

#include <culm/flow/fluid_context.hpp>

namespace culm::water {

void register_potential_flow(flow::FluidLoadRegistry& registry);

}  // namespace culm::water
