/// SeaState's input file, or the part of older HydroDyn files that says the same: waves and
/// currents.
#pragma once

#include <culm/openfast/input_file.hpp>
#include <culm/openfast/report.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace culm::openfast {

/// What the file of a whole turbine or of a driver says for all modules.
struct Surroundings {
  std::filesystem::path path;      ///< empty if there is no such file
  std::optional<double> gravity;   ///< [m/s^2]
  std::optional<double> density;   ///< of the water [kg/m^3]
  std::optional<double> depth;     ///< below mean sea level [m]
  std::optional<double> level;     ///< of still water above mean sea level [m]
  std::filesystem::path seastate;  ///< the file of SeaState; empty if it names none
};

/// From the file beside this one that names it: `.fst`, or a driver. The first one by name where
/// there are several.
Surroundings find_surroundings(const std::filesystem::path& module);
/// From the file of the whole turbine or of a driver. Throws InputError, FileError.
Surroundings read_surroundings(const std::filesystem::path& whole);

/// A sea. Heights are counted from mean sea level.
struct SeaState {
  enum class Kind { still, regular, irregular };
  std::filesystem::path path;
  std::string title;
  double gravity = 9.80665;  ///< [m/s^2]
  double density = 1025.0;   ///< [kg/m^3]
  double depth = 0.0;        ///< of still water [m]
  double level = 0.0;        ///< of still water [m]
  Kind kind = Kind::still;
  double height = 0.0, period = 0.0;  ///< [m, s]
  std::optional<double> peak;         ///< factor of JONSWAP, where the file has it
  double phase = 0.0;                 ///< of a regular wave [rad]
  double heading = 0.0;               ///< counter-clockwise from x [rad]
  std::optional<double> spreading;    ///< exponent of the density of directions
  double spreading_range = 0.0;       ///< [rad]
  std::string stretching = "None";
  double lowest = 0.0, highest = 0.0;  ///< [Hz]; 0 where the file does not limit them
  int seed = 0;
  double rise = 0.0;    ///< in which waves grow in the deck, so that it begins in still water [s]
  std::string current;  ///< type in the deck; empty for none
  double current_speed = 0.0, current_heading = 0.0;   ///< [m/s, rad]
  std::vector<double> current_depths, current_speeds;  ///< of a table [m, m/s]
};

/// Takes the keywords of SeaState as known, in a file of its own or in an older one of HydroDyn.
void ignore_sea(InputFile& file);

/// Throws InputError, FileError; tells the report what it found and what is not in the deck.
SeaState read_seastate(const std::filesystem::path& path, const Surroundings& surroundings,
                       Report& report);

}  // namespace culm::openfast
