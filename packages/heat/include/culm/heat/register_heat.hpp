/// The load type "Temperature".
#pragma once

#include <culm/model/build_context.hpp>

namespace culm::heat {

/// Adds "Temperature" to the types of loads.
void register_heat(model::BuilderRegistry& registry);

}  // namespace culm::heat
