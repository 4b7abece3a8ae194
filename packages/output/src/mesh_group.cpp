#include "mesh_group.hpp"

#include <culm/base/text.hpp>

#include "hdf5_read.hpp"
#include "mesh_tables.hpp"
#include "names.hpp"

#include <string>
#include <vector>

namespace culm::output {
namespace {

void write_directors(Hdf5File& file, hid_t group, Directors kind, const std::vector<Mat3>& triads) {
  for (const int number : director_numbers(kind)) {
    file.write(group, "director" + std::to_string(number), flatten_director(triads, number),
               {triads.size(), 3});
  }
}

void write_node_array_names(Hdf5File& file, hid_t group, const std::vector<NodeArray>& arrays) {
  std::vector<std::string> names;
  std::vector<int> columns;
  for (const NodeArray& array : arrays) {
    names.push_back(array.name);
    columns.push_back(array.columns);
  }
  file.set_attribute(group, "node_array_names", names);
  file.write(group, "node_array_columns", columns);
}

void write_cell_array_names(Hdf5File& file, hid_t group, const std::vector<CellArray>& arrays) {
  std::vector<std::string> names;
  std::vector<std::string> columns;
  for (const CellArray& array : arrays) {
    names.push_back(array.name);
    columns.push_back(join(array.columns, " "));
  }
  file.set_attribute(group, "cell_array_names", names);
  file.set_attribute(group, "cell_array_columns", columns);
}

void write_outlines(Hdf5File& file, hid_t group,
                    const std::vector<std::vector<Eigen::Vector2d>>& outlines) {
  const OutlineTable table = outline_table(outlines);
  if (table.points.empty()) return;
  file.write(group, "outline_of_node", table.of_node);
  file.write(group, "outline_ends", table.ends);
  file.write(group, "outline_points", table.points, {table.points.size() / 2, 2});
}

void write_held(Hdf5File& file, hid_t mesh, const std::vector<HeldNodes>& held) {
  if (held.empty()) return;
  const Handle group = file.make_group(mesh, "constraints");
  int number = 0;
  for (const HeldNodes& one : held) {
    const std::string name = step_name(number++);
    file.write(group.id(), name, one.nodes);
    const Handle dataset = open_dataset(file, group.id(), name);
    file.set_attribute(dataset.id(), "name", one.name);
    file.set_attribute(dataset.id(), "type", one.type);
  }
}

void write_loaded(Hdf5File& file, hid_t mesh, const std::vector<LoadedNodes>& loaded) {
  if (loaded.empty()) return;
  const Handle group = file.make_group(mesh, "loads");
  int number = 0;
  for (const LoadedNodes& one : loaded) {
    const Handle load = file.make_group(group.id(), step_name(number++));
    file.set_attribute(load.id(), "name", one.name);
    file.set_attribute(load.id(), "type", one.type);
    file.write(load.id(), "nodes", one.nodes);
    std::vector<double> actions;
    for (const Vec6& action : one.actions) {
      actions.insert(actions.end(), action.begin(), action.end());
    }
    file.write(load.id(), "actions", actions, {one.actions.size(), 6});
  }
}

// Where the fields of a structure stand in each state.
void write_fields(Hdf5File& file, hid_t mesh, const std::vector<FieldRows>& fields,
                  const std::vector<StateTable>& tables) {
  std::vector<std::string> names, places;
  std::vector<int> rows;
  for (const FieldRows& field : fields) {
    names.push_back(field.field);
    places.push_back(tables[field.table].name);
    rows.push_back(static_cast<int>(field.first));
    rows.push_back(static_cast<int>(field.first + field.rows));
  }
  file.set_attribute(mesh, "fields", names);
  file.set_attribute(mesh, "tables", places);
  file.write(mesh, "field_rows", rows);
}

}  // namespace

void write_mesh(Hdf5File& file, hid_t parent, const StructureMesh& mesh, int number,
                const StateTables& tables) {
  const Handle group = file.make_group(parent, link_name(mesh.name));
  file.set_attribute(group.id(), "name", mesh.name);
  file.set_attribute(group.id(), "type", mesh.type);
  file.set_attribute(group.id(), "number", number);
  file.set_attribute(group.id(), "topology_size",
                     static_cast<int>(xdmf_topology(mesh.cells).size()));
  file.set_attribute(group.id(), "resultant_names", mesh.resultant_names);
  write_node_array_names(file, group.id(), mesh.node_arrays);
  write_cell_array_names(file, group.id(), mesh.cell_arrays);

  file.write(group.id(), "position", flatten(mesh.positions), {mesh.positions.size(), 3});
  write_directors(file, group.id(), mesh.directors, mesh.triads);
  const CellTable cells = cell_table(mesh.cells);
  file.write(group.id(), "cell_types", cells.types);
  file.write(group.id(), "cell_offsets", cells.offsets);
  file.write(group.id(), "connectivity", cells.connectivity);
  write_outlines(file, group.id(), mesh.outlines);
  write_fields(file, group.id(), tables.fields(static_cast<std::size_t>(number)), tables.tables());
  write_held(file, group.id(), mesh.held);
  write_loaded(file, group.id(), mesh.loaded);
}

}  // namespace culm::output
