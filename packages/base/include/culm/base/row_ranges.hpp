#pragma once

#include <cstddef>
#include <vector>

namespace culm {

/// Rows of a table that follow each other.
struct RowRange {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// Rows that a process has of a table, rising.
using RowRanges = std::vector<RowRange>;

/// Adds a row behind the others.
inline void append_row(RowRanges& rows, std::size_t row) {
  if (!rows.empty() && rows.back().first + rows.back().count == row) {
    ++rows.back().count;
  } else {
    rows.push_back({row, 1});
  }
}

/// How many they are.
inline std::size_t count_rows(const RowRanges& rows) {
  std::size_t count = 0;
  for (const RowRange& range : rows) count += range.count;
  return count;
}

}  // namespace culm
