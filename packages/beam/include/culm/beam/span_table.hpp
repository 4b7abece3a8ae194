/// Tables of values along the relative span of a beam.
#pragma once

#include <culm/base/issue.hpp>
#include <culm/base/options.hpp>

#include <string>
#include <vector>

namespace culm::beam {

/// Between which two entries of a table a place lies: the value there is
/// (1 - t) value[first] + t value[second].
struct TablePlace {
  std::size_t first = 0;
  std::size_t second = 0;
  double t = 0.0;
};

/// Place of `span` among positions that do not descend; constant beyond the ends. Where two
/// positions are equal the value jumps, and the later one counts.
/// @pre positions is not empty
TablePlace table_place(const std::vector<double>& positions, double span);

/// Checks positions of a table with `count` values: as many, not descending. Entries outside
/// [0, 1] are for the schema to refuse.
void check_positions(const Options& options, const std::string& positions, std::size_t count,
                     InputIssues& issues);

}  // namespace culm::beam
