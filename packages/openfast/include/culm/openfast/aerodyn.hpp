/// Input files of AeroDyn: primary file, blades and airfoils.
#pragma once

#include <culm/openfast/report.hpp>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace culm::openfast {

/// Coefficients at an angle of attack.
struct AirfoilRow {
  double angle = 0.0;  ///< [rad]
  double lift = 0.0;
  double drag = 0.0;
  double moment = 0.0;  ///< about the quarter chord, nose up
};

/// Which column of a table of an airfoil holds what, counted from 1; 0 where there is none.
struct AirfoilColumns {
  int angle = 1, lift = 2, drag = 3, moment = 4;
};

/// An airfoil over all angles.
struct AirfoilFile {
  std::filesystem::path path;
  std::string name;  ///< of the file, without its ending
  std::vector<AirfoilRow> rows;
};

/// A section of a blade.
struct AeroStation {
  double span = 0.0;        ///< along the axis of the pitch from the root [m]
  double curve = 0.0;       ///< of the quarter chord out of the plane, downwind [m]
  double sweep = 0.0;       ///< of the quarter chord in the plane, towards the trailing edge [m]
  double twist = 0.0;       ///< about -z [rad]
  double chord = 0.0;       ///< [m]
  std::size_t airfoil = 0;  ///< among those of the primary file
};

/// A blade.
struct AeroBlade {
  std::filesystem::path path;
  std::vector<AeroStation> stations;
};

/// The tower as the air sees it at a height.
struct AeroTowerStation {
  double height = 0.0;    ///< above ground or mean sea level [m]
  double diameter = 0.0;  ///< [m]
  double drag = 0.0;
  double turbulence = 0.1;  ///< intensity of the wind there, for a wake of Eames
};

/// What the tower does to the wind about it, in the words of culm's list `Tower Influence`.
struct AeroTowerInfluence {
  std::string upstream = "None";    ///< Potential, Bak
  std::string downstream = "None";  ///< Powles, Eames
  std::vector<AeroTowerStation> shape;
};

/// What AeroDyn's files say, in the words of culm's loads `Rotor` and `Strip`.
struct AeroDyn {
  std::filesystem::path path;
  double density = 0.0;   ///< [kg/m^3]
  std::string induction;  ///< None, Steady, Dynamic
  std::string yaw;        ///< None, Pitt Peters
  std::string lag;        ///< None, Oye, Four States
  bool tip_loss = true;
  bool hub_loss = true;
  bool drag_induces = false;
  bool has_moments = true;
  std::vector<AirfoilFile> airfoils;
  std::vector<AeroBlade> blades;
  std::vector<AeroTowerStation> tower;                ///< empty where it has no drag
  std::optional<AeroTowerInfluence> tower_influence;  ///< none where it is off
};

/// Reads a primary file and the files of blades and airfoils that it names; tells the report what
/// it found, assumed and left out. Throws InputError, FileError.
/// @param blades   number of blades
/// @param density  of the air, where the file says "default" [kg/m^3]
AeroDyn read_aerodyn(const std::filesystem::path& path, std::size_t blades,
                     std::optional<double> density, Report& report);

/// Reads the first table of a file of an airfoil. Throws InputError, FileError: also where it does
/// not reach from -180 to 180 degrees, or has other coefficients there.
AirfoilFile read_airfoil(const std::filesystem::path& path, const AirfoilColumns& columns,
                         Report& report);

}  // namespace culm::openfast
