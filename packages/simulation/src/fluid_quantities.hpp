/// Quantities of loads from fluids.
#pragma once

#include <culm/simulation/quantity.hpp>

namespace culm::simulation {

/// Fluid Force.
void register_fluid_quantities(QuantityRegistry& registry);

}  // namespace culm::simulation
