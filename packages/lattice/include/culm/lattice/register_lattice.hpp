#pragma once

#include <culm/flow/fluid_context.hpp>

namespace culm::lattice {

/// Type of this package in the deck's list "Loads": Vortex Lattice.
void register_lattice(flow::FluidLoadRegistry& registry);

}  // namespace culm::lattice
