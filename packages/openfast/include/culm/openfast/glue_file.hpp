/// The file that names those of all modules, `.fst`, and what ServoDyn says of the yaw drive.
#pragma once

#include <culm/openfast/elastodyn.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace culm::openfast {

/// Modules that are switched on, by their files.
struct GlueFile {
  std::filesystem::path path;
  std::filesystem::path elastodyn;
  std::optional<std::filesystem::path> servodyn;
  std::optional<std::filesystem::path> beamdyn;  ///< blade 1, where BeamDyn computes the blades
  std::optional<double> gravity;                 ///< [m/s^2]
  std::vector<std::string> substructure;         ///< modules that carry the tower, with their files
};

/// Throws InputError, FileError.
GlueFile read_glue_file(const std::filesystem::path& path);

/// The file beside a main file of ElastoDyn that names it; the first one by name where there are
/// several, which the report then tells.
std::optional<GlueFile> find_glue_file(const std::filesystem::path& elastodyn, Report& report);

/// Spring, damper and neutral angle of ServoDyn's file. Throws InputError, FileError.
YawDrive read_yaw_drive(const std::filesystem::path& path, Report& report);

}  // namespace culm::openfast
