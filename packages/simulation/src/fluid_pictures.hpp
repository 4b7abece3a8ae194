/// Fluids as pictures show them: what loads that act in a flow know beside the structures.
#pragma once

#include <culm/model/model.hpp>
#include <culm/model/state.hpp>
#include <culm/output/picture_mesh.hpp>

#include <vector>

namespace culm::simulation {

/// Panels and wakes of all vortex lattices, and the surface of seas that are shown; none if the
/// model has none. Wakes have as many rows as
/// they may get: those that are not there yet lie on the trailing edge.
std::vector<output::StructureMesh> fluid_meshes(const model::Model& model);
/// The same at the end of the last accepted step, without index and time.
output::Picture fluid_picture(const model::Model& model, const model::State& state);

}  // namespace culm::simulation
