/// Input files of InflowWind.
#pragma once

#include <culm/openfast/report.hpp>

#include <filesystem>

namespace culm::openfast {

/// A wind.
struct Wind {
  enum class Kind {
    power_law,  ///< steady
    table,      ///< uniform or sheared, by a file in time
    box         ///< turbulence of a file of TurbSim
  };
  Kind kind = Kind::power_law;
  double speed = 0.0;          ///< of the power law, at its height [m/s]
  double height = 0.0;         ///< of power law and table, above ground or mean sea level [m]
  double exponent = 0.0;       ///< of the power law
  double length = 0.0;         ///< of the linear shears of a table [m]
  double direction = 0.0;      ///< to which it blows, from x towards -y [rad]
  double upflow = 0.0;         ///< [rad]
  std::filesystem::path file;  ///< of table and box
};

/// Reads a file of InflowWind; tells the report what it found, assumed and left out. Winds that are
/// not known, and those whose file is not there, become still air, which the report says with what
/// is nearest. Throws InputError, FileError.
/// @param height  of the hub, for still air [m]
Wind read_inflow(const std::filesystem::path& path, double height, Report& report);

}  // namespace culm::openfast
