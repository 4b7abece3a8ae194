/// The types of a deck that stand for water.
#pragma once

#include <culm/flow/flow.hpp>

namespace culm::water {

/// Types of the deck's list "Flows": Still Water, Regular Waves, Irregular Waves, Wave Components.
void register_seas(flow::FlowRegistry& registry);

}  // namespace culm::water
