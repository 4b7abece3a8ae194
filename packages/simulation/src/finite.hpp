/// Refuses results beyond the range of numbers.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/output/picture_mesh.hpp>

#include <span>
#include <string>
#include <vector>

namespace culm::simulation {

/// Whether all values are numbers; `absent` is one.
bool is_finite(std::span<const double> values);
bool is_finite(const output::Picture& picture);

/// Throws NonFiniteError that names the first value of a history row that is infinite or not a
/// number. @param when  for the message, such as "in step 3 of 'bend', at 0.5"
[[noreturn]] void refuse_infinite(const std::vector<output::HistoryColumn>& columns,
                                  std::span<const double> values, const std::string& when);
/// The same for what is drawn of the structures of a model.
[[noreturn]] void refuse_infinite(const std::vector<output::StructureMesh>& meshes,
                                  const output::Picture& picture);
/// The same if there is one among the numbers and tables of an analysis.
void refuse_infinite(const std::string& analysis, const analysis::AnalysisReport& report);

}  // namespace culm::simulation
