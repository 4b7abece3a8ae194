#include "time_table.hpp"

#include <culm/base/number_file.hpp>
#include <culm/base/text.hpp>

#include <algorithm>
#include <cmath>

namespace culm::model {

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
  TimeTable table;
  InputIssues issues;
  const std::string path = read_number_lines(name, where, [&](const NumberLine& line) {
    if (line.numbers.size() != 2) {
      issues.add(line.where, "must be 'time, value', got '" + shortened(line.text, 60) + "'");
      return;
    }
    const double last = table.times.empty() ? -INFINITY : table.times.back();
    table.times.push_back(line.numbers[0]);
    table.values.push_back(line.numbers[1]);
    if (table.times.back() <= last) {
      issues.add(line.where, "times must increase, got " + format_number(table.times.back()) +
                                 " after " + format_number(last));
    }
  });
  if (table.times.empty() && issues.empty()) issues.add({path, 0, {}}, "holds no points");
  issues.throw_if_any();
  return table;
}

}  // namespace culm::model
