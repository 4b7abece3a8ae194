/// The ways a deck can describe the surface of a shell: list `Mesh`, by `Type`.
#pragma once

#include <culm/base/registry.hpp>
#include <culm/shell/shell_mesh.hpp>

namespace culm::shell {

/// Makers give facets in place. They throw InputError for impossible geometry, FileError for files.
using MeshRegistry = Registry<Facets>;

/// Adds Plane, Cylinder, Sphere, Cone, Annulus, Hypar, Twisted Strip, I Section,
/// Airfoil, Quads and Gmsh.
void register_meshes(MeshRegistry& registry);

}  // namespace culm::shell
