#include <culm/base/absent.hpp>
#include <culm/base/error.hpp>
#include <culm/output/history_csv.hpp>

#include "history_table.hpp"
#include "replace_file.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cerrno>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>

namespace culm::output {

namespace {

constexpr std::chrono::milliseconds longest_wait(100);
constexpr std::size_t most_at_once = 1 << 20;  // bytes

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

void add_line(const HistoryRow& row, std::string& text) {
  fmt::memory_buffer line;
  const fmt::appender end(line);
  // as few digits as give the same number back
  fmt::format_to(end, FMT_COMPILE("{}"), row.time);
  for (const double value : row.values) {
    line.push_back(',');
    if (value != absent) fmt::format_to(end, FMT_COMPILE("{}"), value);
  }
  fmt::format_to(end, FMT_COMPILE(",{},{}\n"), row.analysis, row.step);
  text.append(line.data(), line.size());
}

}  // namespace

HistoryCsv::HistoryCsv(std::filesystem::path path, const std::vector<HistoryColumn>& columns,
                       std::span<const double> rows)
    : path_(std::move(path)), column_count_(columns.size()) {
  // what is there already must not get lost while it is written again
  const std::filesystem::path name = rows.empty() ? path_ : temporary_name(path_);
  file_.reset(std::fopen(name.c_str(), "w"));
  if (!file_) give_up();
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  pending_ = header(columns);
  for (; !rows.empty(); rows = rows.subspan(history_width(column_count_))) {
    add_line(unpack_history(rows.first(history_width(column_count_))), pending_);
    if (pending_.size() > most_at_once) put_pending();
  }
  put_pending();
  if (name != path_) move_into_place(name, path_);
  identity_.emplace(path_);
}

HistoryCsv::~HistoryCsv() {
  // Without a file this is what is left of a moved history.
  if (!file_) return;
  try {
    write();
  } catch (const Error&) {
    // The file keeps its last lines; a destructor has nobody to tell.
  }
}

void HistoryCsv::add(const HistoryRow& row) {
  internal_check(row.values.size() == column_count_, "one value per history column");
  add_line(row, pending_);
  if (Clock::now() - written_at_ > longest_wait) write();
}

void HistoryCsv::write() {
  if (pending_.empty()) return;
  identity_->check(path_);
  put_pending();
}

// At once, so that whoever reads meanwhile finds whole lines; and but once, also where that fails.
void HistoryCsv::put_pending() {
  const std::string text = std::exchange(pending_, {});
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) give_up();
  written_at_ = Clock::now();
}

void HistoryCsv::give_up() const {
  throw FileError(path_.string(), "cannot write: " + std::generic_category().message(errno));
}

}  // namespace culm::output
