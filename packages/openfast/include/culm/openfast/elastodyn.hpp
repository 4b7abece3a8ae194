/// Input files of ElastoDyn: main, blade and tower file of a turbine.
#pragma once

#include <culm/openfast/aerodyn.hpp>
#include <culm/openfast/beamdyn.hpp>
#include <culm/openfast/hydrodyn.hpp>
#include <culm/openfast/inflow.hpp>
#include <culm/openfast/moordyn.hpp>
#include <culm/openfast/subdyn.hpp>

#include <optional>

namespace culm::openfast {

/// A station of the tower file. What the file does not have is empty.
struct TowerStation {
  double height = 0.0;               ///< over the flexible height, from 0 to 1
  double mass = 0.0;                 ///< [kg/m]
  double fore_aft = 0.0;             ///< bending stiffness for motion along the wind [N m^2]
  double side_side = 0.0;            ///< bending stiffness for motion across [N m^2]
  std::optional<double> torsion;     ///< [N m^2]
  std::optional<double> stretch;     ///< [N]
  std::optional<double> inertia_fa;  ///< rotary inertia of bending along the wind [kg m]
  std::optional<double> inertia_ss;  ///< of bending across [kg m]
};

/// A mode shape, phi(x) = sum_k coefficients[k] x^(k + 2), x from 0 to 1, and its damping.
struct FileMode {
  std::string name;
  std::array<double, 5> coefficients{};
  double damping = 0.0;  ///< over the critical one
};

/// Modes of one direction of bending; the second one where the file has it.
struct FileModes {
  FileMode first;
  std::optional<FileMode> second;
};

/// What is below the tower: the platform, which ElastoDyn holds where it has no degree of freedom.
struct Platform {
  std::array<bool, 6> free{};        ///< surge, sway, heave, roll, pitch, yaw
  Vec3 reference = Vec3::Zero();     ///< of its motion [m]
  double mass = 0.0;                 ///< [kg]
  Vec3 centre = Vec3::Zero();        ///< of mass [m]
  Vec3 inertia = Vec3::Zero();       ///< about its centre, roll, pitch, yaw [kg m^2]
  std::vector<std::string> modules;  ///< that carry it, with their files
};

/// The yaw drive, as ServoDyn's file describes it.
struct YawDrive {
  std::filesystem::path path;
  double stiffness = 0.0;  ///< [N m/rad]
  double damping = 0.0;    ///< [N m s/rad]
  double neutral = 0.0;    ///< angle about z [rad]
};

/// The air about a turbine.
struct Air {
  AeroDyn loads;
  Wind wind;
  double end = 0.0;  ///< of the motion [s]
};

/// What carries the tower, and the water on it.
struct Substructure {
  SubDyn frame;
  std::optional<HydroDyn> water;
};

/// A platform that floats.
struct Floater {
  HydroDyn water;
  std::optional<MoorDyn> moorings;
};

/// The tower.
struct ElastoDynTower {
  std::filesystem::path path;
  std::string title;
  std::vector<TowerStation> stations;
  FileModes fore_aft;   ///< along the wind
  FileModes side_side;  ///< across
};

/// A blade: sections and axis in BeamDyn's terms, what the file does not have assumed.
struct ElastoDynBlade {
  BeamDyn beam;
  FileModes flap;
  FileModes edge;
};

/// A turbine. Lengths in m, angles in rad. Downwind is x, up is z.
struct ElastoDyn {
  std::filesystem::path path;
  std::string title;
  double tower_base = 0.0;
  double tower_top = 0.0;
  Vec3 nacelle_centre = Vec3::Zero();  ///< from the top of the tower
  double shaft_height = 0.0;           ///< of the shaft over the top of the tower, at the yaw axis
  double overhang = 0.0;               ///< along the shaft from the yaw axis to the apex, downwind
  double tilt = 0.0;                   ///< of the shaft, positive if it rises downwind
  double hub_radius = 0.0;
  double tip_radius = 0.0;
  double hub_centre = 0.0;  ///< along the shaft from the apex, downwind
  double azimuth = 0.0;     ///< of the first blade; zero upwards, clockwise seen from upwind
  std::vector<double> cones;
  std::vector<double> pitches;
  std::vector<double> tip_masses;  ///< [kg]
  double hub_mass = 0.0;           ///< [kg]
  double hub_inertia = 0.0;        ///< about the shaft [kg m^2]
  double nacelle_mass = 0.0;
  double nacelle_inertia = 0.0;  ///< about the yaw axis [kg m^2]
  double yaw_bearing_mass = 0.0;
  double generator_inertia = 0.0;  ///< about the fast shaft [kg m^2]
  double gear_ratio = 1.0;
  double shaft_stiffness = 0.0;  ///< [N m/rad]
  double shaft_damping = 0.0;    ///< [N m s/rad]
  double rotor_speed = 0.0;      ///< [rad/s]
  double yaw = 0.0;              ///< of the nacelle about z, at the start [rad]
  bool yaw_is_free = false;      ///< YawDOF
  std::optional<YawDrive> yaw_drive;
  Platform platform;
  std::optional<double> gravity;  ///< [m/s^2]
  int blade_nodes = 0;            ///< in ElastoDyn: midpoints of equal parts
  std::vector<ElastoDynBlade> blades;
  ElastoDynTower tower;
  std::optional<Air> air;
  std::optional<Substructure> substructure;
  std::optional<Floater> floater;

  /// The sea about what carries the tower; null without one.
  const SeaState* sea() const {
    if (floater) return &floater->water.sea;
    return substructure && substructure->water ? &substructure->water->sea : nullptr;
  }
  /// Whether the nacelle turns against a spring; without one it would turn without end.
  bool yaws() const { return yaw_is_free && yaw_drive && yaw_drive->stiffness > 0.0; }
  /// Angle about z at which the nacelle stands [rad].
  double yaw_angle() const { return yaws() ? yaw_drive->neutral : yaw; }
  /// Height of the apex of a rotor that is not yawed [m].
  double hub_height() const;
};

/// Reads a main file and the blade and tower files that it names; tells the report what it found,
/// assumed and left out. Throws InputError, FileError.
ElastoDyn read_elastodyn(const std::filesystem::path& path, Report& report);

}  // namespace culm::openfast
