/// Tables of numbers whose columns have names.
#pragma once

#include <culm/openfast/input_file.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace culm::openfast {

/// A table whose first header line names the columns; capitals do not matter. Columns and numbers
/// that are missing throw InputError.
class NamedTable {
 public:
  /// The table below a heading, of at least two lines.
  /// @param count  the entry that announces its lines
  NamedTable(InputFile& file, const std::string& heading, const std::string& count);
  /// The table below the entry `count`, which announces its lines, at least two.
  /// @param columns  numbers that each line must have
  NamedTable(InputFile& file, const std::string& count, int columns, const std::string& what);

  std::size_t size() const { return rows_.size(); }
  int line(std::size_t row) const { return rows_[row].line; }
  bool has(const std::string& column) const;
  double at(std::size_t row, const std::string& column) const;
  std::optional<double> find(std::size_t row, const std::string& column) const;
  /// Throws InputError unless the column rises from 0 to 1.
  void check_places(const std::string& column) const;
  /// Throws InputError unless the value is positive.
  double positive(std::size_t row, const std::string& column) const;

 private:
  void name_columns(const std::vector<std::string>& names);

  const InputFile& file_;
  std::string title_;
  std::map<std::string, std::size_t> columns_;
  std::vector<NumberRow> rows_;
};

}  // namespace culm::openfast
