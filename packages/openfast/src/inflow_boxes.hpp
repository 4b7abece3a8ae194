/// Boxes of turbulence that files of InflowWind name.
#pragma once

#include <culm/openfast/inflow.hpp>
#include <culm/openfast/input_file.hpp>

namespace culm::openfast {

/// WindType 5: boxes for HAWC2, with the mean wind that is added to them.
void read_mann(const InputFile& file, Wind& wind, Report& report);

/// WindType 4: a file of TurbSim in Bladed's format, and the summary (.sum) beside it. Without the
/// summary there is no file in the wind.
void read_bladed_style(const InputFile& file, Wind& wind, Report& report);

/// WindType 7: a file of Bladed by way of a file with its scaling.
void read_native_bladed(const InputFile& file, Wind& wind, Report& report);

}  // namespace culm::openfast
