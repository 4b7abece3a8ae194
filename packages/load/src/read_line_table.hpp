/// Intensities along a line as the deck states them: in lists, or in a file.
#pragma once

#include <culm/model/build_context.hpp>

#include "line_table.hpp"

#include <optional>

namespace culm::load {

/// `Positions` with `Forces`, `Moments`, or `File Name`; `Position Measure`.
Schema line_table_fields();
/// The parameter that holds the forces or the moments: `File Name`, or the given name.
std::string source_of(const char* values, const Options& options);
/// The table that they state, for a line of this length [m]. Nothing, after issues, if positions
/// descend, are too few or outside of the line, or values do not fit them.
std::optional<LineTable> read_line_table(const Options& options, double length,
                                         InputIssues& issues);

}  // namespace culm::load
