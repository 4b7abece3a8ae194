#include <culm/beam/span_table.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace culm::beam {

TablePlace table_place(const std::vector<double>& positions, double span) {
  const auto after = std::upper_bound(positions.begin(), positions.end(), span);
  const std::size_t last = positions.size() - 1;
  if (after == positions.begin()) return {0, 0, 0.0};
  if (after == positions.end()) return {last, last, 0.0};
  const auto second = static_cast<std::size_t>(after - positions.begin());
  const std::size_t first = second - 1;
  return {first, second, (span - positions[first]) / (positions[second] - positions[first])};
}

void check_positions(const Options& options, const std::string& positions, std::size_t count,
                     InputIssues& issues) {
  const auto& values = options.numbers(positions);
  if (values.size() != count) {
    issues.add(options.where(positions),
               fmt::format("must have one position per value: {} values, {} positions", count,
                           values.size()));
  }
  if (!std::is_sorted(values.begin(), values.end())) {
    issues.add(options.where(positions), "must not descend");
  }
}

}  // namespace culm::beam
