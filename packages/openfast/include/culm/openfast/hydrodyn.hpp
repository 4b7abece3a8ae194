/// HydroDyn's input file: members in the water.
#pragma once

#include <culm/math/types.hpp>
#include <culm/openfast/seastate.hpp>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace culm::openfast {

/// Coefficients of a section, bare or with marine growth.
struct HydroCoefficients {
  double drag = 0.0, added_mass = 0.0;  ///< Cd, Ca
  double pressure = 1.0;                ///< Cp, of the force that the undisturbed water exerts
  double buoyancy = 1.0;                ///< Cb
};

/// Coefficients at a place: bare first, then with growth.
using HydroPair = std::array<HydroCoefficients, 2>;

/// Coefficients of the whole at a depth.
struct HydroDepth {
  double depth = 0.0;  ///< below mean sea level [m]
  HydroPair coefficients;
};

/// An end of members.
struct HydroJoint {
  int id = 0;
  Vec3 place = Vec3::Zero();            ///< from mean sea level [m]
  double drag = 0.0, added_mass = 0.0;  ///< of its faces, AxCd, AxCa
};

/// A straight member between two joints.
struct HydroMember {
  int id = 0;
  std::array<std::size_t, 2> joints{};  ///< places in the list of joints
  std::array<double, 2> diameters{};    ///< [m]
  std::array<double, 2> walls{};        ///< [m]
  int coefficients = 1;                 ///< 1 simple, 2 by depth, 3 of its own
  std::array<HydroPair, 2> own{};       ///< at both ends, for 3
  bool has_buoyancy = true;
  bool is_potential = false;  ///< left to potential flow
  bool is_flooded = false;    ///< with sea water up to the still surface
};

/// Marine growth at a depth.
struct HydroGrowth {
  double height = 0.0;     ///< z from mean sea level [m]
  double thickness = 0.0;  ///< [m]
  double density = 0.0;    ///< [kg/m^3]
};

/// What fills a member from below.
struct HydroFilling {
  std::size_t member = 0;  ///< place in the list of members
  double level = 0.0;      ///< of its surface, from mean sea level [m]
  double density = 0.0;    ///< [kg/m^3]
};

/// A body by linear potential flow.
struct HydroPotential {
  std::filesystem::path root;             ///< of the files of WAMIT, without .1, .3, .hst
  double length = 1.0;                    ///< WAMITULEN [m]
  double volume = 0.0;                    ///< displaced [m^3]
  double centre_x = 0.0, centre_y = 0.0;  ///< of the volume [m]
  bool radiates = true;                   ///< whether its waves are remembered
};

/// What the file adds to the forces on the platform, in space about its reference point.
struct HydroAdded {
  std::vector<double> preload;  ///< 6 values [N, N m]
  Mat6 stiffness = Mat6::Zero(), damping = Mat6::Zero(), quadratic = Mat6::Zero();
  bool is_zero = true;
};

/// The file.
struct HydroDyn {
  std::filesystem::path path;
  std::string title;
  SeaState sea;
  std::vector<HydroJoint> joints;
  std::vector<HydroMember> members;
  HydroPair simple;
  std::vector<HydroDepth> by_depth;  ///< sorted
  std::vector<HydroGrowth> growth;   ///< sorted by height
  std::vector<HydroFilling> fillings;
  std::optional<HydroPotential> potential;
  HydroAdded added;
};

/// Reads the file and SeaState's, which the file of the whole turbine names, or the only one beside
/// it. Throws InputError, FileError.
HydroDyn read_hydrodyn(const std::filesystem::path& path, Report& report);
HydroDyn read_hydrodyn(const std::filesystem::path& path, const Surroundings& surroundings,
                       Report& report);

}  // namespace culm::openfast
