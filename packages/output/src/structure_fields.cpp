#include <culm/output/structure_fields.hpp>

#include "mesh_tables.hpp"

namespace culm::output {

StructureFields fields_of(const StructureMesh& mesh) {
  return {.name = mesh.name,
          .type = mesh.type,
          .nodes = mesh.positions.size(),
          .cells = mesh.cells.size(),
          .topology_size = xdmf_topology(mesh.cells).size(),
          .directors = director_numbers(mesh.directors),
          .resultant_names = mesh.resultant_names,
          .node_arrays = mesh.node_arrays,
          .cell_arrays = mesh.cell_arrays};
}

std::vector<StructureFields> fields_of(const std::vector<StructureMesh>& meshes) {
  std::vector<StructureFields> structures;
  for (const StructureMesh& mesh : meshes) structures.push_back(fields_of(mesh));
  return structures;
}

}  // namespace culm::output
