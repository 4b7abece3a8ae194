#include <culm/base/text.hpp>
#include <culm/output/state_tables.hpp>
#include <culm/output/xdmf.hpp>

#include "names.hpp"

#include <fmt/core.h>

#include <utility>

namespace culm::output {

namespace {

std::string dimensions_of(std::size_t rows, int columns) {
  return columns == 1 ? std::to_string(rows) : fmt::format("{} {}", rows, columns);
}

std::string data_item(const std::string& dimensions, const char* type, const std::string& path) {
  return fmt::format(R"(<DataItem Dimensions="{}" {} Format="HDF">{}</DataItem>)", dimensions, type,
                     xml_escape(path));
}

// The grid of a group of structures in one step.
class GridText {
 public:
  /// @param topology  path of the cells @param step  path of the tables
  GridText(const StateGroup& group, const std::vector<StateTable>& tables,
           const std::string& topology, const std::string& step)
      : tables_(tables), step_(step), field_(group.fields.begin()) {
    const StructureFields& structure = group.sizes;
    text_ = fmt::format("<Grid Name=\"{}\" GridType=\"Uniform\">\n", xml_escape(group.name));
    text_ += fmt::format(R"(<Topology TopologyType="Mixed" NumberOfElements="{}">{}</Topology>)"
                         "\n",
                         structure.cells,
                         data_item(std::to_string(structure.topology_size),
                                   R"(NumberType="Int" Precision="4")", topology));
    text_ += fmt::format("<Geometry GeometryType=\"XYZ\">{}</Geometry>\n", next_rows());
    add_attribute("displacement", "Node");
    for (const int number : structure.directors) {
      add_attribute(fmt::format("director{}", number), "Node");
    }
    for (const NodeArray& array : structure.node_arrays) add_attribute(array.name, "Node");
    if (!structure.resultant_names.empty()) {
      // ParaView warns about arrays of one name and different lengths; this name also says what is
      // what.
      add_attribute(join(structure.resultant_names, " "), "Cell");
    }
    for (const CellArray& array : structure.cell_arrays) add_attribute(array.name, "Cell");
    text_ += "</Grid>\n";
  }
  const std::string& text() const { return text_; }

 private:
  // Rows of the next field: a part of a table, or all of it.
  std::string next_rows() {
    const FieldRows& field = *field_++;
    const StateTable& table = tables_[field.table];
    const std::string whole =
        data_item(dimensions_of(table.rows, table.columns), R"(NumberType="Float" Precision="8")",
                  step_ + "/" + table.name);
    if (field.rows == table.rows) return whole;
    const std::string selection =
        table.columns == 1
            ? fmt::format(R"(Dimensions="3 1" Format="XML">{} 1 {})", field.first, field.rows)
            : fmt::format(R"(Dimensions="3 2" Format="XML">{} 0 1 1 {} {})", field.first,
                          field.rows, table.columns);
    return fmt::format(
        R"(<DataItem ItemType="HyperSlab" Dimensions="{}"><DataItem {}</DataItem>{}</DataItem>)",
        dimensions_of(field.rows, table.columns), selection, whole);
  }

  void add_attribute(const std::string& name, const char* center) {
    const int columns = tables_[field_->table].columns;
    const char* const type = columns == 1 ? "Scalar" : columns == 3 ? "Vector" : "Matrix";
    text_ += fmt::format(R"(<Attribute Name="{}" AttributeType="{}" Center="{}">{}</Attribute>)"
                         "\n",
                         xml_escape(name), type, center, next_rows());
  }

  const std::vector<StateTable>& tables_;
  const std::string& step_;
  std::vector<FieldRows>::const_iterator field_;  // that is written next
  std::string text_;
};

constexpr const char* head =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
    "<Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
constexpr const char* tail = "</Grid>\n</Domain>\n</Xdmf>\n";

}  // namespace

XdmfFile::XdmfFile(const std::filesystem::path& path, std::string h5,
                   const std::vector<StructureFields>& structures)
    : h5_(std::move(h5)),
      tables_(std::make_unique<const StateTables>(structures)),
      file_(path, head, tail) {}

XdmfFile::XdmfFile(XdmfFile&&) noexcept = default;
XdmfFile& XdmfFile::operator=(XdmfFile&&) noexcept = default;
XdmfFile::~XdmfFile() = default;

XdmfFile::XdmfFile(const std::filesystem::path& path, std::string h5,
                   const std::vector<StructureMesh>& meshes)
    : XdmfFile(path, std::move(h5), fields_of(meshes)) {}

void XdmfFile::add_step(int index, double time) {
  const std::string number = step_name(index);
  std::string entry = fmt::format(
      "<Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
      "<Time Value=\"{:.17g}\"/>\n",
      number, time);
  const std::string step = fmt::format("{}:/steps/{}", h5_, number);
  int group = 0;
  for (const StateGroup& g : tables_->groups()) {
    const std::string topology = fmt::format("{}:/topologies/{}", h5_, step_name(group++));
    entry += GridText(g, tables_->tables(), topology, step).text();
  }
  file_.add(entry + "</Grid>\n");
}

}  // namespace culm::output
