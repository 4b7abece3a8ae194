#include "picture_grids.hpp"

#include "mesh_tables.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <numeric>
#include <utility>

namespace culm::output {

namespace {

// "N" for N1, N2, N3 at `first`; empty if these are not the names there.
std::string vector_name(const std::vector<std::string>& names, std::size_t first) {
  if (first + 3 > names.size() || names[first].size() < 2) return "";
  const std::string stem = names[first].substr(0, names[first].size() - 1);
  for (std::size_t i = 0; i < 3; ++i) {
    if (names[first + i] != stem + std::to_string(i + 1)) return "";
  }
  return stem;
}

// Columns `first` to `first + columns` of the resultants; one row per entry of `cells`.
std::vector<double> pick(const StructureMesh& mesh, const StructureState& state,
                         const std::vector<int>& cells, std::size_t first, std::size_t columns) {
  std::vector<double> values;
  values.reserve(cells.size() * columns);
  for (const int cell : cells) {
    const std::size_t row = mesh.resultant_names.size() * static_cast<std::size_t>(cell);
    for (std::size_t c = first; c < first + columns; ++c) {
      values.push_back(state.resultants[row + c]);
    }
  }
  return values;
}

// Numbers of cells of a structure, one per cell of a grid.
using CellNumbers = std::shared_ptr<const std::vector<int>>;

std::vector<VtuArray> resultant_arrays(const StructureMesh& mesh, const StructureState& state,
                                       const CellNumbers& cells) {
  std::vector<VtuArray> arrays;
  const std::vector<std::string>& names = mesh.resultant_names;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto from = [&mesh, &state, cells, i](std::size_t columns) {
      return [=, &mesh, &state] { return pick(mesh, state, *cells, i, columns); };
    };
    arrays.push_back({names[i], 1, from(1)});
    const std::string vector = vector_name(names, i);
    if (vector.empty()) continue;
    arrays.push_back({vector, 3, from(3), {names[i], names[i + 1], names[i + 2]}});
  }
  return arrays;
}

// All cells in their order.
std::vector<VtuArray> cell_data(const StructureMesh& mesh, const StructureState& state,
                                const CellNumbers& cells) {
  std::vector<VtuArray> arrays = resultant_arrays(mesh, state, cells);
  for (std::size_t a = 0; a < mesh.cell_arrays.size(); ++a) {
    const CellArray& array = mesh.cell_arrays[a];
    arrays.push_back({array.name, static_cast<int>(array.columns.size()),
                      [&state, a] { return state.cell_values[a]; }, array.columns});
  }
  return arrays;
}

std::vector<VtuArray> node_data(const StructureMesh& mesh, const StructureState& state) {
  std::vector<VtuArray> arrays{
      {"displacement", 3,
       [&mesh, &state] { return flatten_difference(state.positions, reference_of(mesh, state)); }}};
  for (const int number : director_numbers(mesh.directors)) {
    arrays.push_back({"director" + std::to_string(number), 3,
                      [&state, number] { return flatten_director(state.triads, number); }});
  }
  for (std::size_t a = 0; a < mesh.node_arrays.size(); ++a) {
    const NodeArray& array = mesh.node_arrays[a];
    arrays.push_back({array.name, array.columns, [&state, a] { return state.node_values[a]; }});
  }
  return arrays;
}

// Lines as VTK's curves of two, three and four nodes, which have both ends first. Readers other
// than those of VTK know these, but no polylines.
CellTable curve_table(const std::vector<Cell>& cells) {
  constexpr std::array curves = {3, 21, 35};
  CellTable table = cell_table(cells);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].type != CellType::line) continue;
    const std::size_t nodes = cells[c].nodes.size();
    table.types[c] = curves.at(nodes - 2);
    const auto end = table.connectivity.begin() + table.offsets[c];
    std::rotate(end - static_cast<std::ptrdiff_t>(nodes) + 1, end - 1, end);
  }
  return table;
}

}  // namespace

VtuGrid centre_grid(const StructureMesh& mesh, const StructureState& state, int number) {
  const CellTable table = curve_table(mesh.cells);
  std::vector<int> cells(table.types.size());
  std::iota(cells.begin(), cells.end(), 0);
  const auto all = std::make_shared<const std::vector<int>>(std::move(cells));
  return {.points = flatten(state.positions),
          .connectivity = table.connectivity,
          .offsets = table.offsets,
          .types = table.types,
          .structures = std::vector<int>(all->size(), number),
          .point_data = node_data(mesh, state),
          .cell_data = cell_data(mesh, state, all)};
}

VtuGrid skin_grid(const StructureMesh& mesh, const StructureState& state, int number,
                  const Skin& skin, std::vector<Vec3> reference) {
  constexpr int quad = 9, polygon = 7;
  std::vector<Vec3> points = skin.points(state.positions, state.triads);
  VtuGrid grid;
  grid.points = flatten(points);
  std::vector<int> cells;
  for (const Skin::Face& face : skin.faces()) {
    grid.connectivity.insert(grid.connectivity.end(), face.points.begin(), face.points.end());
    grid.offsets.push_back(static_cast<int>(grid.connectivity.size()));
    grid.types.push_back(face.points.size() == 4 ? quad : polygon);
    cells.push_back(face.cell);
  }
  grid.structures.assign(cells.size(), number);
  grid.point_data.push_back(
      {"displacement", 3, [points = std::move(points), reference = std::move(reference)] {
         return flatten_difference(points, reference);
       }});
  grid.cell_data =
      resultant_arrays(mesh, state, std::make_shared<const std::vector<int>>(std::move(cells)));
  return grid;
}

}  // namespace culm::output
