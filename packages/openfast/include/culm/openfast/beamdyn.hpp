/// Input files of BeamDyn: driver, primary file, blade file.
#pragma once

#include <culm/math/types.hpp>
#include <culm/openfast/report.hpp>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace culm::openfast {

/// A station of the blade file. Order of both matrices: forces along x (flap), y (edge), z (span),
/// moments about x, y, z; axes of the section, origin on the reference axis.
struct BladeStation {
  double span = 0.0;              ///< along the reference axis, from 0 to 1
  Mat6 stiffness = Mat6::Zero();  ///< [N, N m, N m^2]
  Mat6 mass = Mat6::Zero();       ///< [kg/m, kg, kg m]
  int line = 0;                   ///< where it stands
};

/// Sections of a blade.
struct BeamDynBlade {
  std::filesystem::path path;
  std::string title;
  std::vector<BladeStation> stations;
  /// Times by which stress runs ahead of strain, per component; zero without damping [s]
  std::array<double, 6> damping{};
};

/// A point of the reference axis.
struct KeyPoint {
  Vec3 position = Vec3::Zero();  ///< in the frame of the blade root [m]
  double twist = 0.0;            ///< about -z, as the file has it [rad]
};

/// A blade.
struct BeamDyn {
  std::filesystem::path path;
  std::string title;
  std::vector<KeyPoint> key_points;
  int members = 1;
  int order = 5;  ///< of the elements in BeamDyn
  BeamDynBlade blade;
};

/// A force and a moment at a place of the blade, with components in space.
struct PointLoad {
  double span = 1.0;           ///< from 0 to 1
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 moment = Vec3::Zero();  ///< [N m]
};

/// What the driver does to one blade. Vectors have components in space.
struct BeamDynDriver {
  std::filesystem::path path;
  std::string title;
  bool dynamic = false;
  double start = 0.0;                    ///< [s]
  double end = 0.0;                      ///< [s]
  double step = 0.0;                     ///< [s]
  Vec3 gravity = Vec3::Zero();           ///< [m/s^2]
  Vec3 root = Vec3::Zero();              ///< place of the blade root [m]
  Mat3 axes = Mat3::Identity();          ///< columns: axes x, y, z of the blade root
  Vec3 angular_velocity = Vec3::Zero();  ///< of the root about the origin [rad/s]
  Vec3 line_force = Vec3::Zero();        ///< [N/m]
  Vec3 line_moment = Vec3::Zero();       ///< [N m/m]
  std::vector<PointLoad> point_loads;    ///< that at the tip included, if there is one
  BeamDyn beam;
};

/// Reads a primary file and the blade file that it names; tells the report what it found. Throws
/// InputError, FileError.
BeamDyn read_beamdyn(const std::filesystem::path& path, Report& report);
/// Reads a driver file and what it names.
BeamDynDriver read_beamdyn_driver(const std::filesystem::path& path, Report& report);

}  // namespace culm::openfast
