/// A model as pictures show it.
#pragma once

#include <culm/simulation/result_files.hpp>

#include <vector>

namespace culm::simulation {

/// The structures in the reference configuration.
std::vector<output::StructureMesh> meshes_of(const model::Model& model,
                                             const LayerSettings& layers);

/// The structures in a configuration that is up to date for all nodes; index and time stay zero.
output::Frame frame_of(const model::Model& model, const LayerSettings& layers,
                       const model::Coordinates& q);

}  // namespace culm::simulation
