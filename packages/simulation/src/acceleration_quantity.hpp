/// The acceleration of a point, as an accelerometer would be compared with.
#pragma once

#include <culm/simulation/quantity.hpp>

namespace culm::simulation {

/// Registers "Acceleration".
void register_acceleration_quantity(QuantityRegistry& registry);

}  // namespace culm::simulation
