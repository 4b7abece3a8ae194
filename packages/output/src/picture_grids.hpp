/// Meshes and states as grids of VTK.
#pragma once

#include <culm/output/picture_mesh.hpp>
#include <culm/output/skin.hpp>

#include "vtu_grid.hpp"

namespace culm::output {

/// Nodes and cells with displacement, directors, node arrays and resultants.
/// @param number  of the structure in the model
VtuGrid centre_grid(const StructureMesh& mesh, const StructureState& state, int number);

/// The skin with displacement and resultants.
/// @param reference  points of the skin in the reference configuration
VtuGrid skin_grid(const StructureMesh& mesh, const StructureState& state, int number,
                  const Skin& skin, const std::vector<Vec3>& reference);

}  // namespace culm::output
