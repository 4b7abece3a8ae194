/// Soil around piles.
#pragma once

#include <culm/model/build_context.hpp>

namespace culm::soil {

/// The type "Soil" of the deck's list "Loads".
void register_soil(model::BuilderRegistry& registry);

}  // namespace culm::soil
