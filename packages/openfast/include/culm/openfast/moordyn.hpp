/// Mooring lines: MoorDyn's input file, of version 1 and 2, and that of MAP++, which looks like
/// version 1.
#pragma once

#include <culm/math/types.hpp>
#include <culm/openfast/seastate.hpp>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace culm::openfast {

/// A kind of line.
struct LineType {
  std::string name;
  double diameter = 0.0;   ///< [m]
  double mass = 0.0;       ///< in air [kg/m]
  double stiffness = 0.0;  ///< EA [N]
  double friction = 0.0;   ///< on the seabed, of MAP++ [-]
};

/// Where lines end.
struct MooringPoint {
  enum class Kind { fixed, vessel, free };
  int id = 0;
  Kind kind = Kind::fixed;
  Vec3 place = Vec3::Zero();  ///< in space, or from the reference point of the vessel [m]
};

/// A line between two points.
struct MooringLine {
  int id = 0;
  std::size_t type = 0;
  std::array<std::size_t, 2> points{};
  double length = 0.0;  ///< without tension [m]
};

/// The file.
struct MoorDyn {
  std::filesystem::path path;
  std::string title;
  double gravity = 9.80665;  ///< [m/s^2]
  double density = 1025.0;   ///< of the water [kg/m^3]
  std::vector<LineType> types;
  std::vector<MooringPoint> points;
  std::vector<MooringLine> lines;
  std::vector<InputIssue> left_out;  ///< what carries lines and is not imported, with its place
};

/// Weight of a line less its buoyancy [N/m].
double wet_weight(const MoorDyn& file, const LineType& type);

/// Throws InputError, FileError; tells the report what it found and what is not in the deck.
MoorDyn read_moordyn(const std::filesystem::path& path, Report& report);
/// @param surroundings  what the file of the whole turbine says
MoorDyn read_moordyn(const std::filesystem::path& path, const Surroundings& surroundings,
                     Report& report);

}  // namespace culm::openfast
