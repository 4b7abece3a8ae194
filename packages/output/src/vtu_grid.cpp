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

// An array of all grids: what some of them have of it, and from which row on.
struct JoinedArray {
  VtuArray array;  // the first of its name
  std::vector<std::pair<std::size_t, std::function<std::vector<double>()>>> parts = {};
};

// Lets data of one grid be the rows from `first` on.
void place(std::vector<JoinedArray>& target, const std::vector<VtuArray>& source,
           std::size_t first) {
  for (const VtuArray& array : source) {
    auto found = std::ranges::find_if(target, [&array](const JoinedArray& other) {
      return other.array.name == array.name && other.array.columns == array.columns;
    });
    if (found == target.end()) found = target.insert(target.end(), {array});
    found->parts.emplace_back(first, array.values);
  }
}

// Arrays of so many rows.
std::vector<VtuArray> join_parts(std::vector<JoinedArray> joined, std::size_t rows) {
  std::vector<VtuArray> arrays;
  for (JoinedArray& one : joined) {
    const auto columns = static_cast<std::size_t>(one.array.columns);
    one.array.values = [parts = std::move(one.parts), columns, rows] {
      std::vector<double> all(rows * columns, std::numeric_limits<double>::quiet_NaN());
      for (const auto& [first, values] : parts) {
        std::ranges::copy(values(), all.begin() + static_cast<std::ptrdiff_t>(first * columns));
      }
      return all;
    };
    arrays.push_back(std::move(one.array));
  }
  return arrays;
}

}  // namespace

VtuGrid merge(std::vector<VtuGrid> grids) {
  if (grids.size() == 1) return std::move(grids.front());
  VtuGrid all;
  std::vector<JoinedArray> point_data, cell_data;
  for (const VtuGrid& grid : grids) {
    const std::size_t first_point = point_count(all);
    const std::size_t first_cell = all.types.size();
    place(point_data, grid.point_data, first_point);
    place(cell_data, grid.cell_data, first_cell);
    append(all.offsets, grid.offsets, static_cast<int>(all.connectivity.size()));
    append(all.connectivity, grid.connectivity, static_cast<int>(first_point));
    append(all.points, grid.points);
    append(all.types, grid.types);
    append(all.structures, grid.structures);
  }
  all.point_data = join_parts(std::move(point_data), point_count(all));
  all.cell_data = join_parts(std::move(cell_data), all.types.size());
  return all;
}

}  // namespace culm::output
