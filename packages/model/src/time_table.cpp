#include "time_table.hpp"

#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>
#include <culm/base/text.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string_view>

namespace culm::model {
namespace {

std::optional<double> find_number(std::string_view text) {
  text = trim(text);
  double value = 0.0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc() || end != last || !std::isfinite(value)) return {};
  return value;
}

// Adds the point of a line to the table; false if it holds none.
bool read_point(std::string_view line, TimeTable& table) {
  const auto comma = line.find(',');
  if (comma == std::string_view::npos) return false;
  const auto time = find_number(line.substr(0, comma));
  const auto value = find_number(line.substr(comma + 1));
  if (!time || !value) return false;
  table.times.push_back(*time);
  table.values.push_back(*value);
  return true;
}

}  // namespace

double TimeTable::value(double time) const {
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return values.front();
  if (after == times.end()) return values.back();
  const auto i = static_cast<std::size_t>(after - times.begin());
  const double xi = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return (1.0 - xi) * values[i - 1] + xi * values[i];
}

std::string TimeTable::mistake(const std::vector<double>& times,
                               const std::vector<double>& values) {
  if (times.size() != values.size()) {
    return "must have as many items as Values, got " + std::to_string(times.size()) + " and " +
           std::to_string(values.size());
  }
  const auto pair = std::adjacent_find(times.begin(), times.end(), std::greater_equal<>());
  if (pair == times.end()) return {};
  return "must increase, got " + format_number(pair[0]) + " before " + format_number(pair[1]);
}

TimeTable read_time_table(const std::string& name, const Where& where) {
  const std::string path = (std::filesystem::path(where.file).parent_path() / name).string();
  std::istringstream file(read_file(path, where));
  TimeTable table;
  InputIssues issues;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::string_view text = trim(std::string_view(line).substr(0, line.find('#')));
    if (text.empty()) continue;
    const double last = table.times.empty() ? -INFINITY : table.times.back();
    const Where here{path, number, {}};
    if (!read_point(text, table)) {
      issues.add(here, "must be 'time, value', got '" + shortened(text, 60) + "'");
    } else if (table.times.back() <= last) {
      issues.add(here, "times must increase, got " + format_number(table.times.back()) + " after " +
                           format_number(last));
    }
  }
  if (table.times.empty() && issues.empty()) issues.add({path, 0, {}}, "holds no points");
  issues.throw_if_any();
  return table;
}

}  // namespace culm::model
