/// Meshes and states as grids of VTK.
#pragma once

#include <culm/output/picture_mesh.hpp>
#include <culm/output/skin.hpp>

#include "vtu_grid.hpp"

namespace culm::output {

// Arrays are made from mesh and state when they are written, so both must live until then.

/// Nodes and cells with displacement, directors, node arrays and resultants.
/// @param number  of the structure in the model
VtuGrid centre_grid(const StructureMesh& mesh, const StructureState& state, int number);

/// The skin with displacement and resultants.
/// @param reference  points of the skin in the reference configuration
VtuGrid skin_grid(const StructureMesh& mesh, const StructureState& state, int number,
                  const Skin& skin, std::vector<Vec3> reference);

}  // namespace culm::output
