/// Pictures of points that belong to no mesh.
#pragma once

#include <culm/output/picture_mesh.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace culm::output {

/// Writes points as a VTU file, each as a vertex. Throws FileError.
/// @param structures  the number of the structure of each point
/// @param arrays      point data, one row per point
/// @param names       of structures by their number, for the field data
void write_points(const std::filesystem::path& path, const std::vector<Vec3>& points,
                  const std::vector<int>& structures, const std::vector<NamedArray>& arrays,
                  const std::vector<std::string>& names);

}  // namespace culm::output
