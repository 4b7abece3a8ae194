/// The ways a deck can describe the surface of a shell: list `Mesh`, by `Type`.
#pragma once

#include <culm/base/registry.hpp>
#include <culm/shell/shell_mesh.hpp>

namespace culm::shell {

/// Makers take how many elements each one of the deck is divided into, along both its directions,
/// and give facets in place; those that know nothing but corners leave it to subdivide(). They
/// throw InputError for impossible geometry, FileError for files.
using MeshRegistry = Registry<Facets, int>;

/// How many facets a mesh will have without refinement.
struct FacetCount {
  double all = 0.0;
  double narrow = 1.0;  ///< across the narrow side; 1 where that is not known
};
/// For a mesh of these types; of none where only its file knows.
FacetCount count_facets(const Options& mesh);

/// Adds Plane, Cylinder, Sphere, Cone, Annulus, Hypar, Twisted Strip, I Section,
/// Airfoil, Quads and Gmsh.
void register_meshes(MeshRegistry& registry);

}  // namespace culm::shell
