/// Tables whose columns have names.
#pragma once

#include <culm/openfast/input_file.hpp>

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace culm::openfast {

/// Lines of a table below the names of its columns and, where there is one, a line of units in
/// brackets. Columns are found by their names, of which formats of several years have different
/// ones; capitals do not matter.
class TextTable {
 public:
  /// A name, and others that the column has in other years.
  using Names = std::initializer_list<const char*>;

  /// @param what       the table, for messages
  /// @param announced  how many lines it must have, or nothing where the file does not say it
  /// Throws InputError where the number of lines is another one.
  TextTable(const InputFile& file, std::string what, std::vector<TextRow> rows,
            std::optional<int> announced);

  std::size_t size() const { return rows_.size(); }
  bool has(Names names) const { return find(names).has_value(); }

  // These throw InputError if there is no such column, the line ends before it, or it holds
  // something else.
  std::string text(std::size_t row, Names names) const;
  double number(std::size_t row, Names names) const;
  int integer(std::size_t row, Names names) const;
  /// The same, or `otherwise` where there is no such column.
  double number(std::size_t row, Names names, double otherwise) const;
  /// Empty where there is no such column, or the line ends before it.
  std::string optional_text(std::size_t row, Names names) const;
  /// The lines as they are, for columns that hold lists.
  const TextRow& row(std::size_t row) const { return rows_[row]; }
  Where where(std::size_t row, Names names) const;

 private:
  std::optional<std::size_t> find(Names names) const;

  const InputFile* file_;
  std::string what_;
  std::vector<std::string> columns_;
  std::vector<TextRow> rows_;
};

/// The table below an entry that says how many lines it has.
TextTable read_table(InputFile& file, const std::string& keyword, const std::string& what);

/// Places of the lines of a table by the whole number in a column, which stands there once. Throws
/// InputError.
std::map<int, std::size_t> index_rows(const TextTable& table, TextTable::Names names);

/// The line of another table, indexed as `rows`, that the number in a column names. Throws
/// InputError, which calls such a line `what` and tells those that there are.
std::size_t look_up(const std::map<int, std::size_t>& rows, const TextTable& table, std::size_t row,
                    TextTable::Names names, const std::string& what);

}  // namespace culm::openfast
