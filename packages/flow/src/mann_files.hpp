/// Boxes of turbulence as HAWC2 and Mann's generator write them.
#pragma once

#include "turbulence_grid.hpp"

#include <array>
#include <string>
#include <vector>

namespace culm::flow {

/// Reads three files of numbers in single precision, one for each component, upwards fastest, then
/// across from the left, seen along the wind, then planes, the first of which arrives first: as
/// OpenFAST reads them. Throws InputError with the path and what is wrong.
/// @param names    along, across, upwards; relative to the folder of the deck, or absolute
/// @param where    the place of the names in the deck
/// @param points   planes, across, upwards
/// @param spacing  likewise [m]
/// @param speed    with which planes move [m/s]
TurbulenceGrid read_mann(const std::vector<std::string>& names, const Where& where,
                         const std::array<int, 3>& points, const std::array<double, 3>& spacing,
                         double speed);

}  // namespace culm::flow
