/// Constraint equations that follow from others.
#pragma once

#include <culm/model/constraint.hpp>
#include <culm/model/node_table.hpp>

#include <string>
#include <vector>

namespace culm::model {

/// Removes rows that depend on others in the reference, where all rows hold: in closed loops of
/// plane mechanisms, two hinges on one axis, joints between nodes that supports hold. Constraints
/// that lose all rows are removed. Null-space form only: rows are judged by what they do to the
/// unknowns, H P. Rows that depend on others in this position alone, as in a stretched four-bar
/// loop, are not told apart: start such a model in another position.
/// @return a sentence for each constraint that lost rows
/// @source formulation 2.8
std::vector<std::string> remove_redundant_rows(const NodeTable& nodes,
                                               std::vector<Constraint>& equations);

}  // namespace culm::model
