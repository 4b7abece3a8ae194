#include <culm/base/absent.hpp>
#include <culm/base/error.hpp>
#include <culm/output/history_csv.hpp>

#include "history_table.hpp"
#include "replace_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <iterator>
#include <string>
#include <system_error>

namespace culm::output {

namespace {

// Quoted as in RFC 4180 if the text would otherwise break the line into other fields.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string header(const std::vector<HistoryColumn>& columns) {
  std::string line = "time";
  for (const HistoryColumn& column : columns) {
    line += ',' + field(column.unit.empty() ? column.name
                                            : fmt::format("{} [{}]", column.name, column.unit));
  }
  return line + ",analysis,step\n";
}

std::string line(const HistoryRow& row) {
  fmt::memory_buffer line;
  // as few digits as give the same number back
  fmt::format_to(std::back_inserter(line), "{}", row.time);
  for (const double value : row.values) {
    line.push_back(',');
    if (value != absent) fmt::format_to(std::back_inserter(line), "{}", value);
  }
  fmt::format_to(std::back_inserter(line), ",{},{}\n", row.analysis, row.step);
  return fmt::to_string(line);
}

}  // namespace

HistoryCsv::HistoryCsv(std::filesystem::path path, const std::vector<HistoryColumn>& columns,
                       std::span<const double> rows)
    : path_(std::move(path)), column_count_(columns.size()) {
  // what is there already must not get lost while it is written again
  const std::filesystem::path name = rows.empty() ? path_ : temporary_name(path_);
  file_.reset(std::fopen(name.c_str(), "w"));
  if (!file_) give_up();
  write(header(columns));
  for (; !rows.empty(); rows = rows.subspan(history_width(column_count_))) {
    write(line(unpack_history(rows.first(history_width(column_count_)))));
  }
  flush();
  if (name != path_) move_into_place(name, path_);
  identity_.emplace(path_);
}

void HistoryCsv::add(const HistoryRow& row) {
  internal_check(row.values.size() == column_count_, "one value per history column");
  write(line(row));
  flush();
  identity_->check(path_);
}

void HistoryCsv::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) give_up();
}

void HistoryCsv::flush() {
  if (std::fflush(file_.get()) != 0) give_up();
}

void HistoryCsv::give_up() const {
  throw FileError(path_.string(), "cannot write: " + std::generic_category().message(errno));
}

}  // namespace culm::output
