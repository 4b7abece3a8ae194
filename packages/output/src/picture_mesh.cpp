#include <culm/base/error.hpp>
#include <culm/output/picture_mesh.hpp>

#include <fmt/core.h>

#include <cstddef>
#include <set>

namespace culm::output {

namespace {

bool has_valid_nodes(const Cell& cell, int node_count) {
  const std::size_t n = cell.nodes.size();
  bool valid = false;
  switch (cell.type) {
    case CellType::vertex:
      valid = n == 1;
      break;
    case CellType::line:
      valid = n >= 2 && n <= 4;
      break;
    case CellType::quad4:
      valid = n == 4;
      break;
  }
  for (const int node : cell.nodes) valid = valid && node >= 0 && node < node_count;
  return valid;
}

void check_mesh(const StructureMesh& mesh) {
  const auto demand = [&mesh](bool condition, const char* rule) {
    if (!condition) throw InternalError(fmt::format("mesh of '{}': {}", mesh.name, rule));
  };
  const std::size_t nodes = mesh.positions.size();
  demand(!mesh.name.empty() && !mesh.type.empty(), "name and type must not be empty");
  demand(mesh.directors == Directors::none || mesh.triads.size() == nodes, "one triad per node");
  demand(mesh.outlines.empty() || mesh.outlines.size() == nodes, "one outline per node");
  demand(mesh.outlines.empty() || mesh.directors == Directors::triad, "outlines need triads");
  for (const Cell& cell : mesh.cells) {
    demand(has_valid_nodes(cell, mesh.node_count()), "wrong number of nodes or unknown node");
  }
  for (const NodeArray& array : mesh.node_arrays) {
    demand(array.columns > 0, "a node array needs a column");
  }
  for (const CellArray& array : mesh.cell_arrays) {
    demand(!array.columns.empty(), "a cell array needs a column");
  }
}

}  // namespace

void check_meshes(const std::vector<StructureMesh>& meshes) {
  std::set<std::string_view> names;
  for (const StructureMesh& mesh : meshes) {
    check_mesh(mesh);
    internal_check(names.insert(mesh.name).second, fmt::format("two meshes '{}'", mesh.name));
  }
}

void check_picture(const std::vector<StructureMesh>& meshes, const Picture& picture) {
  internal_check(picture.structures.size() == meshes.size(), "one state per structure");
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const StructureMesh& mesh = meshes[s];
    const StructureState& state = picture.structures[s];
    const auto demand = [&mesh](bool condition, const char* rule) {
      if (!condition) throw InternalError(fmt::format("state of '{}': {}", mesh.name, rule));
    };
    const std::size_t nodes = mesh.positions.size();
    demand(state.positions.size() == nodes, "one position per node");
    demand(mesh.directors == Directors::none || state.triads.size() == nodes, "one triad per node");
    demand(reference_of(mesh, state).size() == nodes &&
               state.reference_triads.size() == state.reference_positions.size(),
           "one place and one triad per node in a geometry of its own");
    demand(state.resultants.size() == mesh.cells.size() * mesh.resultant_names.size(),
           "one number per cell and resultant name");
    demand(state.node_values.size() == mesh.node_arrays.size(), "values for each node array");
    for (std::size_t a = 0; a < mesh.node_arrays.size(); ++a) {
      const auto columns = static_cast<std::size_t>(mesh.node_arrays[a].columns);
      demand(state.node_values[a].size() == nodes * columns, "columns per node in a node array");
    }
    demand(state.cell_values.size() == mesh.cell_arrays.size(), "values for each cell array");
    for (std::size_t a = 0; a < mesh.cell_arrays.size(); ++a) {
      demand(state.cell_values[a].size() == mesh.cells.size() * mesh.cell_arrays[a].columns.size(),
             "columns per cell in a cell array");
    }
  }
}

const std::vector<Vec3>& reference_of(const StructureMesh& mesh, const StructureState& state) {
  return state.reference_positions.empty() ? mesh.positions : state.reference_positions;
}

std::vector<int> director_numbers(Directors directors) {
  switch (directors) {
    case Directors::none:
      break;
    case Directors::single:
      return {3};
    case Directors::triad:
      return {1, 2, 3};
  }
  return {};
}

}  // namespace culm::output
