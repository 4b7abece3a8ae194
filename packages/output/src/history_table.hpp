/// The history as the result file has it, a table of numbers: time, values, analysis, step.
#pragma once

#include <culm/output/picture_mesh.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace culm::output {

/// Numbers of a row.
inline std::size_t history_width(std::size_t columns) { return columns + 3; }

inline void pack_history(const HistoryRow& row, std::vector<double>& table) {
  table.push_back(row.time);
  table.insert(table.end(), row.values.begin(), row.values.end());
  table.push_back(row.analysis);
  table.push_back(row.step);
}

/// @param numbers  history_width of them; the row refers to them
inline HistoryRow unpack_history(std::span<const double> numbers) {
  const std::size_t columns = numbers.size() - history_width(0);
  return {numbers.front(), numbers.subspan(1, columns), static_cast<int>(numbers[columns + 1]),
          static_cast<int>(numbers.back())};
}

}  // namespace culm::output
