#include <culm/output/state_tables.hpp>

#include "mesh_tables.hpp"
#include "names.hpp"

#include <algorithm>
#include <utility>

namespace culm::output {

namespace {

bool have_same_fields(const StructureFields& a, const StructureFields& b) {
  const auto same_nodes = [](const NodeArray& x, const NodeArray& y) {
    return x.name == y.name && x.columns == y.columns;
  };
  const auto same_cells = [](const CellArray& x, const CellArray& y) {
    return x.name == y.name && x.columns == y.columns;
  };
  return a.type == b.type && a.directors == b.directors && a.resultant_names == b.resultant_names &&
         std::ranges::equal(a.node_arrays, b.node_arrays, same_nodes) &&
         std::ranges::equal(a.cell_arrays, b.cell_arrays, same_cells);
}

// Those of the fields of a structure, in their order.
std::vector<double> field_values(std::size_t field, const StructureMesh& mesh,
                                 const StructureState& state) {
  if (field == 0) return flatten(state.positions);
  if (field == 1) return flatten_difference(state.positions, reference_of(mesh, state));
  field -= 2;
  const std::vector<int> directors = director_numbers(mesh.directors);
  if (field < directors.size()) return flatten_director(state.triads, directors[field]);
  field -= directors.size();
  if (field < state.node_values.size()) return state.node_values[field];
  field -= state.node_values.size();
  if (!mesh.resultant_names.empty() && field-- == 0) return state.resultants;
  return state.cell_values[field];
}

}  // namespace

StateTables::StateTables(const std::vector<StructureFields>& structures)
    : fields_(structures.size()) {
  make_groups(structures);
  for (StateGroup& group : groups_) {
    for (const std::size_t number : group.structures) {
      const StructureFields& s = structures[number];
      std::vector<FieldRows>& fields = fields_[number];
      add(fields, "position", 3, s.nodes);
      add(fields, "displacement", 3, s.nodes);
      for (const int director : s.directors) {
        add(fields, "director" + std::to_string(director), 3, s.nodes);
      }
      for (const NodeArray& array : s.node_arrays) {
        add(fields, array.name, array.columns, s.nodes);
      }
      if (!s.resultant_names.empty()) {
        add(fields, "resultants", static_cast<int>(s.resultant_names.size()), s.cells, true);
      }
      for (const CellArray& array : s.cell_arrays) {
        add(fields, array.name, static_cast<int>(array.columns.size()), s.cells, true);
      }
      if (group.fields.empty()) {
        group.fields = fields;
      } else {
        for (std::size_t f = 0; f < fields.size(); ++f) group.fields[f].rows += fields[f].rows;
      }
    }
  }
}

void StateTables::make_groups(const std::vector<StructureFields>& structures) {
  for (std::size_t s = 0; s < structures.size(); ++s) {
    const StructureFields& own = structures[s];
    auto group = std::ranges::find_if(
        groups_, [&](const StateGroup& g) { return have_same_fields(g.sizes, own); });
    if (group == groups_.end()) {
      const auto alike = std::ranges::count_if(
          groups_, [&](const StateGroup& g) { return g.sizes.type == own.type; });
      const std::string name = alike == 0 ? own.type : own.type + " " + std::to_string(1 + alike);
      group = groups_.insert(groups_.end(), {name, {}, own, {}});
    } else {
      group->sizes.nodes += own.nodes;
      group->sizes.cells += own.cells;
      group->sizes.topology_size += own.topology_size;
    }
    group->structures.push_back(s);
  }
}

// Fields of one name with other numbers of columns are other tables.
void StateTables::add(std::vector<FieldRows>& fields, const std::string& field, int columns,
                      std::size_t rows, bool is_of_cells) {
  std::size_t table = 0;
  int alike = 0;
  for (; table < tables_.size(); ++table) {
    if (field_of_[table] != field) continue;
    if (tables_[table].columns == columns) break;
    ++alike;
  }
  if (table == tables_.size()) {
    const std::string name = alike == 0 ? field : field + "/" + std::to_string(1 + alike);
    tables_.push_back({link_name(name), columns, 0});
    field_of_.push_back(field);
  }
  fields.push_back({field, table, tables_[table].rows, rows, is_of_cells});
  tables_[table].rows += rows;
}

std::vector<double> StateTables::values(std::size_t table,
                                        const std::vector<StructureMesh>& reference,
                                        const std::vector<StructureState>& states) const {
  std::vector<double> values;
  each_field(table, [&](std::size_t s, std::size_t f) {
    std::vector<double> numbers = field_values(f, reference[s], states[s]);
    if (values.empty()) {
      values = std::move(numbers);
    } else {
      values.insert(values.end(), numbers.begin(), numbers.end());
    }
  });
  return values;
}

RowRanges StateTables::rows(std::size_t table, const std::vector<StructurePart>& parts) const {
  RowRanges rows;
  each_field(table, [&](std::size_t s, std::size_t f) {
    const FieldRows& field = fields_[s][f];
    for (RowRange range : field.is_of_cells ? parts[s].cells : parts[s].nodes) {
      range.first += field.first;
      rows.push_back(range);
    }
  });
  return rows;
}

// Calls action(structure, number of the field) for all that stands in a table, in its order.
template <class Action>
void StateTables::each_field(std::size_t table, Action action) const {
  for (const StateGroup& group : groups_) {
    for (const std::size_t s : group.structures) {
      for (std::size_t f = 0; f < fields_[s].size(); ++f) {
        if (fields_[s][f].table == table) action(s, f);
      }
    }
  }
}

std::vector<int> StateTables::topology(const StateGroup& group,
                                       const std::vector<StructureMesh>& meshes) {
  std::vector<Cell> cells;
  int nodes = 0;
  for (const std::size_t s : group.structures) {
    for (Cell cell : meshes[s].cells) {
      for (int& node : cell.nodes) node += nodes;
      cells.push_back(std::move(cell));
    }
    nodes += meshes[s].node_count();
  }
  return xdmf_topology(cells);
}

}  // namespace culm::output
