/// Files of TurbSim with velocities on all of a grid (.bts).
#pragma once

#include "turbulence_grid.hpp"

#include <string>

namespace culm::flow {

/// Reads a .bts file without the points of a tower below the grid; throws InputError with the path
/// and what is wrong where it is broken.
/// @param name   relative to the folder of the deck, or absolute
/// @param where  the place of the name in the deck
TurbulenceGrid read_turbsim(const std::string& name, const Where& where);

}  // namespace culm::flow
