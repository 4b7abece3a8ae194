#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/openfast/text_table.hpp>

#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::openfast {

TextTable::TextTable(const InputFile& file, std::string what, std::vector<TextRow> rows,
                     std::optional<int> announced)
    : file_(&file), what_(std::move(what)), rows_(std::move(rows)) {
  const int line = rows_.empty() ? 0 : rows_.front().line;
  if (!rows_.empty()) {
    for (const std::string& name : rows_.front().words) columns_.push_back(to_lower(name));
    rows_.erase(rows_.begin());
  }
  std::erase_if(rows_, [](const TextRow& row) { return row.words.front().front() == '('; });
  if (!announced || static_cast<int>(rows_.size()) == *announced) return;
  throw InputError(
      file.where(rows_.empty() ? line : rows_.back().line, what_),
      fmt::format("must be {} lines, as the file says, found {}", *announced, rows_.size()));
}

std::optional<std::size_t> TextTable::find(Names names) const {
  for (const char* name : names) {
    const auto found = std::find(columns_.begin(), columns_.end(), to_lower(name));
    if (found != columns_.end()) return static_cast<std::size_t>(found - columns_.begin());
  }
  return {};
}

Where TextTable::where(std::size_t row, Names names) const {
  return file_->where(rows_[row].line, fmt::format("{}, {}", what_, *names.begin()));
}

std::string TextTable::text(std::size_t row, Names names) const {
  const auto column = find(names);
  if (!column) throw InputError(where(row, names), "the table has no such column");
  const std::vector<std::string>& words = rows_[row].words;
  if (*column < words.size()) return words[*column];
  throw InputError(where(row, names), fmt::format("the line ends before it, after {} of {} columns",
                                                  words.size(), columns_.size()));
}

std::string TextTable::optional_text(std::size_t row, Names names) const {
  const auto column = find(names);
  const std::vector<std::string>& words = rows_[row].words;
  return column && *column < words.size() ? words[*column] : std::string();
}

double TextTable::number(std::size_t row, Names names) const {
  const std::string word = text(row, names);
  const auto value = find_number(word);
  if (!value) throw InputError(where(row, names), "must be a number, got '" + word + "'");
  return *value;
}

double TextTable::number(std::size_t row, Names names, double otherwise) const {
  return has(names) ? number(row, names) : otherwise;
}

int TextTable::integer(std::size_t row, Names names) const {
  const double value = number(row, names);
  constexpr double largest = 1e9;
  if (value == std::floor(value) && std::abs(value) <= largest) return static_cast<int>(value);
  throw InputError(where(row, names), "must be a whole number, got '" + text(row, names) + "'");
}

TextTable read_table(InputFile& file, const std::string& keyword, const std::string& what) {
  const int count = file.integer(keyword);
  if (count < 0) throw InputError(file.where(keyword), fmt::format("must be >= 0, got {}", count));
  return {file, what, file.rows_after(keyword), count};
}

std::map<int, std::size_t> index_rows(const TextTable& table, TextTable::Names names) {
  std::map<int, std::size_t> rows;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (rows.emplace(table.integer(i, names), i).second) continue;
    throw InputError(table.where(i, names),
                     fmt::format("{} stands there twice", table.integer(i, names)));
  }
  return rows;
}

std::size_t look_up(const std::map<int, std::size_t>& rows, const TextTable& table, std::size_t row,
                    TextTable::Names names, const std::string& what) {
  const int id = table.integer(row, names);
  const auto found = rows.find(id);
  if (found != rows.end()) return found->second;
  std::string known;
  for (const auto& [one, place] : rows)
    known += fmt::format("{}{}", known.empty() ? "" : ", ", one);
  throw InputError(table.where(row, names), fmt::format("there is no {} {} (there are: {})", what,
                                                        id, known.empty() ? "none" : known));
}

}  // namespace culm::openfast
