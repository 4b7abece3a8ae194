#include "vtu_grid.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace culm::output {

namespace {

std::size_t point_count(const VtuGrid& grid) { return grid.points.size() / 3; }

template <class T>
void append(std::vector<T>& target, const std::vector<T>& source, T shift = 0) {
  for (const T& value : source) target.push_back(value + shift);
}

// Copies data of one grid into the rows from `first` on of arrays that have `rows` rows in all.
void place(std::vector<VtuArray>& target, const std::vector<VtuArray>& source, std::size_t first,
           std::size_t rows) {
  for (const VtuArray& array : source) {
    const auto columns = static_cast<std::size_t>(array.columns);
    auto found = std::find_if(target.begin(), target.end(), [&array](const VtuArray& other) {
      return other.name == array.name && other.columns == array.columns;
    });
    if (found == target.end()) {
      const std::vector<double> missing(rows * columns, std::numeric_limits<double>::quiet_NaN());
      target.push_back({array.name, array.columns, missing, array.column_names});
      found = target.end() - 1;
    }
    std::copy(array.values.begin(), array.values.end(),
              found->values.begin() + static_cast<std::ptrdiff_t>(first * columns));
  }
}

}  // namespace

VtuGrid merge(std::vector<VtuGrid> grids) {
  if (grids.size() == 1) return std::move(grids.front());
  std::size_t points = 0;
  std::size_t cells = 0;
  for (const VtuGrid& grid : grids) {
    points += point_count(grid);
    cells += grid.types.size();
  }
  VtuGrid all;
  for (const VtuGrid& grid : grids) {
    const std::size_t first_point = point_count(all);
    const std::size_t first_cell = all.types.size();
    place(all.point_data, grid.point_data, first_point, points);
    place(all.cell_data, grid.cell_data, first_cell, cells);
    append(all.offsets, grid.offsets, static_cast<int>(all.connectivity.size()));
    append(all.connectivity, grid.connectivity, static_cast<int>(first_point));
    append(all.points, grid.points);
    append(all.types, grid.types);
    append(all.structures, grid.structures);
  }
  return all;
}

}  // namespace culm::output
