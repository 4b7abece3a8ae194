#include <culm/output/point_picture.hpp>

#include "vtu_grid.hpp"

namespace culm::output {

void write_points(const std::filesystem::path& path, const std::vector<Vec3>& points,
                  const std::vector<int>& structures, const std::vector<NamedArray>& arrays,
                  const std::vector<std::string>& names) {
  constexpr int vertex = 1;  // VTK_VERTEX
  VtuGrid grid;
  for (const Vec3& x : points) {
    grid.points.insert(grid.points.end(), x.begin(), x.end());
    grid.connectivity.push_back(static_cast<int>(grid.connectivity.size()));
    grid.offsets.push_back(static_cast<int>(grid.connectivity.size()));
  }
  grid.types.assign(points.size(), vertex);
  grid.structures = structures;
  for (const NamedArray& array : arrays) {
    grid.point_data.push_back({array.name, array.columns, [&array] { return array.values; }});
  }
  write_vtu(path, grid, 0.0, names);
}

}  // namespace culm::output
