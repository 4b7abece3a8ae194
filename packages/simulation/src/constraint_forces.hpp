/// What supports and joints exert, by their names.
#pragma once

#include <culm/assembly/system.hpp>
#include <culm/output/picture_mesh.hpp>

#include <vector>

namespace culm::simulation {

/// Of each support, joint and drive one array "constraint forces: <name>" with a row for each of
/// its nodes, in the order of the deck: place x y z [m] of the node, force [N] on the structure
/// there and moment [N m] about the node, all in space. Supports without equations that hold one
/// node together share what it takes; then each shows the sum. Rigid connections and what belongs
/// to the mechanics of a structure are left out.
/// @param state  of an accepted step, up to date for all nodes; the forces are those of the step
std::vector<output::NamedArray> constraint_forces(const assembly::System& system,
                                                  const model::State& state);

}  // namespace culm::simulation
