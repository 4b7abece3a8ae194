#include "named_table.hpp"

#include <culm/base/error.hpp>
#include <culm/base/text.hpp>

#include <fmt/format.h>

namespace culm::openfast {

NamedTable::NamedTable(InputFile& file, const std::string& heading, const std::string& count)
    : file_(file), title_(heading) {
  name_columns(file.columns_below(heading));
  rows_ = file.numbers_below(heading);
  if (static_cast<int>(rows_.size()) != file.integer(count) || rows_.size() < 2) {
    throw InputError(file.where(count),
                     fmt::format("announces {} lines (at least 2), but below {} there are {}",
                                 file.integer(count), heading, rows_.size()));
  }
}

NamedTable::NamedTable(InputFile& file, const std::string& count, int columns,
                       const std::string& what)
    : file_(file), title_(what) {
  const int lines = file.integer(count);
  if (lines < 2) {
    throw InputError(file.where(count), fmt::format("must be at least 2, got {}", lines));
  }
  name_columns(file.columns_after(count));
  rows_ = file.table(count, lines, columns, what);
}

void NamedTable::name_columns(const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) columns_.emplace(to_lower(names[i]), i);
}

bool NamedTable::has(const std::string& column) const {
  return columns_.contains(to_lower(column));
}

double NamedTable::at(std::size_t row, const std::string& column) const {
  const auto found = columns_.find(to_lower(column));
  if (found == columns_.end()) {
    throw InputError(file_.where(0, title_), "has no column '" + column + "'");
  }
  const NumberRow& numbers = rows_[row];
  if (found->second >= numbers.values.size()) {
    throw InputError(file_.where(numbers.line, column),
                     fmt::format("is missing: the line has {} numbers", numbers.values.size()));
  }
  return numbers.values[found->second];
}

std::optional<double> NamedTable::find(std::size_t row, const std::string& column) const {
  return has(column) ? std::optional(at(row, column)) : std::nullopt;
}

void NamedTable::check_places(const std::string& column) const {
  for (std::size_t i = 0; i < size(); ++i) {
    const double place = at(i, column);
    const bool ends = (i == 0 && place != 0.0) || (i + 1 == size() && place != 1.0);
    if (ends || (i > 0 && place <= at(i - 1, column))) {
      throw InputError(file_.where(rows_[i].line, column),
                       fmt::format("places must rise from 0 to 1, got {:g}", place));
    }
  }
}

double NamedTable::positive(std::size_t row, const std::string& column) const {
  const double value = at(row, column);
  if (!(value > 0.0)) {
    throw InputError(file_.where(rows_[row].line, column),
                     fmt::format("must be positive, got {:g}", value));
  }
  return value;
}

}  // namespace culm::openfast
