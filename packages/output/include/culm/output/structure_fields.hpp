#pragma once

#include <culm/output/picture_mesh.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace culm::output {

/// What each state holds of a structure: names and sizes.
struct StructureFields {
  std::string name;
  std::string type;
  std::size_t nodes = 0;
  std::size_t cells = 0;
  std::size_t topology_size = 0;  ///< of the cells in XDMF
  std::vector<int> directors;     ///< numbers of those written
  std::vector<std::string> resultant_names;
  std::vector<NodeArray> node_arrays;
  std::vector<CellArray> cell_arrays;
};

/// Those of a structure.
StructureFields fields_of(const StructureMesh& mesh);
/// Those of structures, in the order of the meshes.
std::vector<StructureFields> fields_of(const std::vector<StructureMesh>& meshes);

}  // namespace culm::output
