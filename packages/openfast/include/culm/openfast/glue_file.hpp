/// The file that names those of all modules, `.fst`, and what ServoDyn says of the yaw drive.
#pragma once

#include <culm/openfast/elastodyn.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace culm::openfast {

/// Modules that are switched on, by their files.
struct GlueFile {
  std::filesystem::path path;
  std::filesystem::path elastodyn;
  std::optional<std::filesystem::path> servodyn;
  /// Primary files by blade, where BeamDyn computes the blades; as many as are named, else none.
  std::vector<std::filesystem::path> beamdyn;
  std::optional<std::filesystem::path> aerodyn;
  std::optional<std::filesystem::path> inflow;
  std::optional<std::filesystem::path> seastate;
  std::optional<std::filesystem::path> hydrodyn;
  std::optional<std::filesystem::path> subdyn;
  std::optional<std::filesystem::path> moordyn;  ///< or the file of MAP++
  std::optional<double> gravity;                 ///< [m/s^2]
  std::optional<double> air_density;             ///< [kg/m^3]
  std::optional<double> end;                     ///< of the simulation [s]
  std::vector<std::string> substructure;         ///< modules that carry the tower, with their files
  /// What it means if the water, or the moorings, stay out of the deck: by switch.
  std::map<std::string, std::string> unless_imported;
};

/// Reads the file; tells the report what is switched on and cannot be imported, and what that does.
/// Throws InputError, FileError.
GlueFile read_glue_file(const std::filesystem::path& path, Report& report);

/// The file beside a main file of ElastoDyn that names it; the first one by name where there are
/// several, which the report then tells.
std::optional<GlueFile> find_glue_file(const std::filesystem::path& elastodyn, Report& report);

/// Spring, damper and neutral angle of ServoDyn's file. Throws InputError, FileError.
YawDrive read_yaw_drive(const std::filesystem::path& path, Report& report);

}  // namespace culm::openfast
