/// Input files of ElastoDyn: main, blade and tower file of a turbine.
#pragma once

#include <culm/openfast/beamdyn.hpp>

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

/// The tower.
struct ElastoDynTower {
  std::filesystem::path path;
  std::string title;
  std::vector<TowerStation> stations;
  FileMode fore_aft;   ///< first mode along the wind
  FileMode side_side;  ///< first mode across
};

/// A blade: sections and axis in BeamDyn's terms, what the file does not have assumed.
struct ElastoDynBlade {
  BeamDyn beam;
  FileMode flap;  ///< first modes
  FileMode edge;
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
  int blade_nodes = 0;           ///< in ElastoDyn: midpoints of equal parts
  std::vector<ElastoDynBlade> blades;
  ElastoDynTower tower;
};

/// Reads a main file and the blade and tower files that it names; tells the report what it found,
/// assumed and left out. Throws InputError, FileError.
ElastoDyn read_elastodyn(const std::filesystem::path& path, Report& report);

}  // namespace culm::openfast
