/// The quantity of mooring lines.
#pragma once

#include <culm/simulation/quantity.hpp>

namespace culm::simulation {

/// Line.
void register_line_quantity(QuantityRegistry& registry);

}  // namespace culm::simulation
