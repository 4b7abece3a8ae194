#include <culm/base/error.hpp>
#include <culm/output/history_csv.hpp>

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
  return line + '\n';
}

}  // namespace

HistoryCsv::HistoryCsv(std::filesystem::path path, std::vector<HistoryColumn> columns)
    : path_(std::move(path)), column_count_(columns.size()), file_(std::fopen(path_.c_str(), "w")) {
  if (!file_) {
    throw FileError(path_.string(), "cannot write: " + std::generic_category().message(errno));
  }
  write(header(columns));
}

void HistoryCsv::add(double time, std::span<const double> values) {
  internal_check(values.size() == column_count_, "one value per history column");
  fmt::memory_buffer line;
  fmt::format_to(std::back_inserter(line), "{:.17g}", time);
  for (const double value : values) {
    fmt::format_to(std::back_inserter(line), ",{:.17g}", value);
  }
  line.push_back('\n');
  write(fmt::to_string(line));
}

void HistoryCsv::write(const std::string& line) {
  const bool written = std::fwrite(line.data(), 1, line.size(), file_.get()) == line.size();
  if (!written || std::fflush(file_.get()) != 0) {
    throw FileError(path_.string(), "cannot write: " + std::generic_category().message(errno));
  }
}

}  // namespace culm::output
