/// Modes at 0 Hz: motions of a whole that floats, and mechanisms.
#pragma once

#include <culm/analysis/find_modes.hpp>

namespace culm::analysis {

/// Whether a shape displaces all nodes as one rigid body would, to 1e-3 of its size; q are the
/// coordinates of the nodes. A body of one node may turn without moving it.
bool is_rigid(const Shape& shape, const model::Coordinates& q);

/// Combinations, a column each, of n >= 2 modes at 0 Hz of unit energy: first those that move the
/// centre of mass, then the others by how far they displace nodes. What displaces nothing, as a
/// free beam that turns about its axis, comes last and by itself. shapes[k] are displacements and
/// rotations of all nodes.
Eigen::MatrixXd combine_zero_modes(const std::vector<std::vector<Vec6>>& shapes,
                                   const model::Model& model, const model::State& state);

}  // namespace culm::analysis
