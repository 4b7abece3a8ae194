/// The types of a deck that stand for water.
#pragma once

#include <culm/flow/fluid_context.hpp>

namespace culm::water {

/// Types of the deck's list "Flows": Still Water, Regular Waves, Irregular Waves, Wave Components.
void register_seas(flow::FlowRegistry& registry);

/// Types of the deck's list "Loads": Morison, Potential Flow.
void register_water_loads(flow::FluidLoadRegistry& registry);

}  // namespace culm::water
