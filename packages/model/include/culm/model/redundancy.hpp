/// Constraint equations that follow from others.
#pragma once

#include <culm/model/constraint.hpp>
#include <culm/model/node_table.hpp>
#include <culm/model/unknowns.hpp>

#include <vector>

namespace culm::model {

/// Constraints whose equations depend on each other.
struct RedundantSet {
  /// How the dependence is to be judged.
  enum class Kind {
    structural,     ///< in every position: the dependent rows follow from the others
    contradictory,  ///< a prescribed motion is held by the others
    position,       ///< in this position only, as in a stretched four-bar loop
  };
  struct Row {
    int equation = 0;  ///< number of the constraint
    int row = 0;
  };
  Kind kind = Kind::structural;
  std::vector<int> members;    ///< numbers of the constraints, rising
  std::vector<Row> dependent;  ///< rows that the others imply
};

/// Finds sets of rows that depend on each other: in closed loops of plane mechanisms, two hinges on
/// one axis, joints between nodes that supports hold. Rows are judged by what they do to the
/// unknowns, H P, at a configuration where all of them hold, and again at one nearby where they
/// hold, too: dependence that is gone there belongs to the position.
/// @param equations constraints that are kept as equations, without internal ones
/// @param start     the configuration, or one near it
/// @source formulation 2.8
std::vector<RedundantSet> find_redundant_rows(const NodeTable& nodes,
                                              const std::vector<Constraint>& equations, Form form,
                                              const Coordinates& start);

}  // namespace culm::model
