/// A model as pictures show it.
#pragma once

#include <culm/simulation/result_files.hpp>

#include <vector>

namespace culm::simulation {

/// The structures in the reference configuration.
std::vector<output::StructureMesh> meshes_of(const model::Model& model,
                                             const LayerSettings& layers);

/// The structures in a configuration; index and time stay zero. Collective; on rank 0 only.
/// @param q  up to date for all nodes on rank 0, elsewhere for those that the rank needs
output::Picture picture_of(const assembly::System& system, const LayerSettings& layers,
                           const model::Coordinates& q);

/// Lets displacements of a picture start from the geometry of this model, which imperfections may
/// have bent against that of the mesh.
void add_reference(const model::Model& model, output::Picture& picture);

/// Makes velocities of nodes [m/s], and angular velocities of those with triads [rad/s], part of
/// what is shown of the structures.
void show_velocities(std::vector<output::StructureMesh>& meshes);

/// Adds these numbers to a picture; zero in statics. The state must be up to date for all nodes.
void add_velocities(const model::Model& model, const model::State& state, output::Picture& picture);

}  // namespace culm::simulation
