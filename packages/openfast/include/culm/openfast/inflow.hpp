/// Input files of InflowWind.
#pragma once

#include <culm/openfast/report.hpp>

#include <filesystem>
#include <vector>

namespace culm::openfast {

/// Turbulence of three files for HAWC2. Lists are along the wind, across it, upwards.
struct MannFiles {
  std::vector<std::filesystem::path> files;
  std::vector<int> points;
  std::vector<double> spacing;     ///< [m]
  std::vector<double> factors;     ///< on the components; none if empty
  std::vector<double> deviations;  ///< to which components are scaled; not if empty [m/s]
  bool loses_means = false;        ///< of the component along the wind, at each point
};

/// What a file of Bladed does not say of itself.
struct BladedFile {
  std::vector<double> intensities;  ///< none if the file has them
  bool is_left_handed = false;      ///< components across point to the right, seen along the wind
  bool is_clockwise = false;        ///< points across begin at the left
  bool is_periodic = false;
};

/// A wind.
struct Wind {
  enum class Kind {
    power_law,  ///< steady
    table,      ///< uniform or sheared, by a file in time
    box,        ///< turbulence of a file of TurbSim
    mann,       ///< a mean wind, and turbulence of three files for HAWC2
    bladed      ///< turbulence of a file of Bladed; with a mean wind where the speed is not zero
  };
  Kind kind = Kind::power_law;
  double speed = 0.0;          ///< of the mean wind, at its height [m/s]
  double height = 0.0;         ///< of mean wind and table, above ground or mean sea level [m]
  double exponent = 0.0;       ///< of the power law
  double roughness = 0.0;      ///< of a logarithmic law in place of it; none if 0 [m]
  double length = 0.0;         ///< of the linear shears of a table [m]
  double direction = 0.0;      ///< to which it blows, from x towards -y [rad]
  double upflow = 0.0;         ///< [rad]
  double centre = 0.0;         ///< height of the middle of a box [m]
  double ahead = 0.0;          ///< of the hub, where a box is at the start [m]
  std::filesystem::path file;  ///< of table and box, in the formats of TurbSim and Bladed
  MannFiles mann = {};
  BladedFile bladed = {};
};

/// Reads a file of InflowWind; tells the report what it found, assumed and left out. Winds that are
/// not known, and those whose file is not there, become still air, which the report says with what
/// is nearest. Throws InputError, FileError.
/// @param height  of the hub, for still air [m]
Wind read_inflow(const std::filesystem::path& path, double height, Report& report);

}  // namespace culm::openfast
