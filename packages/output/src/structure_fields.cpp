#include <culm/output/structure_fields.hpp>

#include "mesh_tables.hpp"

namespace culm::output {

std::vector<StructureFields> fields_of(const std::vector<StructureMesh>& meshes) {
  std::vector<StructureFields> structures;
  for (const StructureMesh& mesh : meshes) {
    structures.push_back({.name = mesh.name,
                          .type = mesh.type,
                          .nodes = mesh.positions.size(),
                          .cells = mesh.cells.size(),
                          .topology_size = xdmf_topology(mesh.cells).size(),
                          .directors = director_numbers(mesh.directors),
                          .resultant_names = mesh.resultant_names,
                          .node_arrays = mesh.node_arrays,
                          .cell_arrays = mesh.cell_arrays});
  }
  return structures;
}

}  // namespace culm::output
