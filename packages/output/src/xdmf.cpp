#include <culm/base/text.hpp>
#include <culm/output/xdmf.hpp>

#include "mesh_tables.hpp"
#include "names.hpp"

#include <fmt/core.h>

#include <utility>

namespace culm::output {

namespace {

XdmfStructure describe(const StructureMesh& mesh) {
  return {.name = mesh.name,
          .nodes = mesh.positions.size(),
          .cells = mesh.cells.size(),
          .topology_size = xdmf_topology(mesh.cells).size(),
          .directors = director_numbers(mesh.directors),
          .resultant_names = mesh.resultant_names,
          .node_arrays = mesh.node_arrays,
          .cell_arrays = mesh.cell_arrays};
}

std::vector<XdmfStructure> describe(const std::vector<StructureMesh>& meshes) {
  std::vector<XdmfStructure> structures;
  for (const StructureMesh& mesh : meshes) structures.push_back(describe(mesh));
  return structures;
}

// Paths of the datasets of one structure in one step.
struct Place {
  std::string mesh;
  std::string step;
};

std::string data_item(const std::string& dimensions, const std::string& type,
                      const std::string& path) {
  return fmt::format(R"(<DataItem Dimensions="{}" {} Format="HDF">{}</DataItem>)", dimensions, type,
                     xml_escape(path));
}

std::string attribute(const std::string& name, const char* center, int columns, std::size_t rows,
                      const std::string& path) {
  const char* const type = columns == 1 ? "Scalar" : columns == 3 ? "Vector" : "Matrix";
  const std::string dimensions =
      columns == 1 ? std::to_string(rows) : fmt::format("{} {}", rows, columns);
  return fmt::format(R"(<Attribute Name="{}" AttributeType="{}" Center="{}">{}</Attribute>)"
                     "\n",
                     xml_escape(name), type, center,
                     data_item(dimensions, R"(NumberType="Float" Precision="8")", path));
}

std::string grid(const XdmfStructure& structure, const Place& place) {
  const std::size_t nodes = structure.nodes;
  std::string text =
      fmt::format("<Grid Name=\"{}\" GridType=\"Uniform\">\n", xml_escape(structure.name));
  text += fmt::format(R"(<Topology TopologyType="Mixed" NumberOfElements="{}">{}</Topology>)"
                      "\n",
                      structure.cells,
                      data_item(std::to_string(structure.topology_size),
                                R"(NumberType="Int" Precision="4")", place.mesh + "/topology"));
  text += fmt::format(R"(<Geometry GeometryType="XYZ">{}</Geometry>)"
                      "\n",
                      data_item(fmt::format("{} 3", nodes), R"(NumberType="Float" Precision="8")",
                                place.step + "/position"));
  text += attribute("displacement", "Node", 3, nodes, place.step + "/displacement");
  for (const int number : structure.directors) {
    const std::string name = fmt::format("director{}", number);
    text += attribute(name, "Node", 3, nodes, place.step + "/" + name);
  }
  for (const NodeArray& array : structure.node_arrays) {
    text += attribute(array.name, "Node", array.columns, nodes,
                      place.step + "/" + link_name(array.name));
  }
  if (!structure.resultant_names.empty()) {
    // ParaView warns about arrays of one name and different lengths; this name also says what is
    // what.
    text += attribute(join(structure.resultant_names, " "), "Cell",
                      static_cast<int>(structure.resultant_names.size()), structure.cells,
                      place.step + "/resultants");
  }
  for (const CellArray& array : structure.cell_arrays) {
    text += attribute(array.name, "Cell", static_cast<int>(array.columns.size()), structure.cells,
                      place.step + "/" + link_name(array.name));
  }
  return text + "</Grid>\n";
}

constexpr const char* head =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
    "<Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
constexpr const char* tail = "</Grid>\n</Domain>\n</Xdmf>\n";

}  // namespace

XdmfFile::XdmfFile(const std::filesystem::path& path, std::string h5,
                   std::vector<XdmfStructure> structures)
    : h5_(std::move(h5)), structures_(std::move(structures)), file_(path, head, tail) {}

XdmfFile::XdmfFile(const std::filesystem::path& path, std::string h5,
                   const std::vector<StructureMesh>& meshes)
    : XdmfFile(path, std::move(h5), describe(meshes)) {}

void XdmfFile::add_step(int index, double time) {
  const std::string step = step_name(index);
  std::string entry = fmt::format(
      "<Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
      "<Time Value=\"{:.17g}\"/>\n",
      step, time);
  for (const XdmfStructure& structure : structures_) {
    const std::string name = link_name(structure.name);
    entry += grid(structure, {.mesh = fmt::format("{}:/mesh/{}", h5_, name),
                              .step = fmt::format("{}:/steps/{}/{}", h5_, step, name)});
  }
  file_.add(entry + "</Grid>\n");
}

}  // namespace culm::output
