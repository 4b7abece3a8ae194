/// Where the numbers of structures stand in the tables of a state.
#pragma once

#include <culm/base/row_ranges.hpp>
#include <culm/output/structure_fields.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace culm::output {

/// A field of all structures that have it, one after the other: few tables per state, however many
/// structures there are.
struct StateTable {
  std::string name;  ///< of the dataset
  int columns = 1;
  std::size_t rows = 0;
};

/// Rows of a table.
struct FieldRows {
  std::string field;  ///< position, displacement, director1..3, resultants, or name of an array
  std::size_t table = 0;
  std::size_t first = 0;
  std::size_t rows = 0;
  bool is_of_cells = false;
};

/// Structures of one type with the same fields, which follow each other in all tables.
struct StateGroup {
  std::string name;  ///< the type; with a number where there are several
  std::vector<std::size_t> structures;
  StructureFields sizes;  ///< of all of them together
  std::vector<FieldRows> fields;
};

/// The nodes and cells of a structure that a process has.
struct StructurePart {
  RowRanges nodes;
  RowRanges cells;
};

/// The tables of the states of a model.
class StateTables {
 public:
  /// @param structures  whole, whoever has them
  explicit StateTables(const std::vector<StructureFields>& structures);

  const std::vector<StateTable>& tables() const { return tables_; }
  const std::vector<StateGroup>& groups() const { return groups_; }
  /// Fields of a structure: position, displacement, directors, arrays of nodes, resultants if it
  /// has some, arrays of cells.
  const std::vector<FieldRows>& fields(std::size_t structure) const { return fields_[structure]; }
  /// All numbers of a state in a table, or those of parts of the structures.
  /// @param reference  of the displacements; of the same nodes
  std::vector<double> values(std::size_t table, const std::vector<StructureMesh>& reference,
                             const std::vector<StructureState>& states) const;
  /// The rows of a table that these are.
  RowRanges rows(std::size_t table, const std::vector<StructurePart>& parts) const;
  /// The cells of a group in XDMF, with the nodes numbered through its structures.
  static std::vector<int> topology(const StateGroup& group,
                                   const std::vector<StructureMesh>& meshes);

 private:
  template <class Action>
  void each_field(std::size_t table, Action action) const;
  void make_groups(const std::vector<StructureFields>& structures);
  void add(std::vector<FieldRows>& fields, const std::string& field, int columns, std::size_t rows,
           bool is_of_cells = false);

  std::vector<StateTable> tables_;
  std::vector<std::string> field_of_;  ///< by table
  std::vector<StateGroup> groups_;
  std::vector<std::vector<FieldRows>> fields_;
};

}  // namespace culm::output
