/// Finer meshes of quadrilaterals that are known by their corners only.
#pragma once

#include <culm/shell/shell_mesh.hpp>

namespace culm::shell {

/// Divides each quadrilateral into refinement x refinement. The surface between its corners is a
/// patch of cubic edges that stand normal to the directors, so that it follows a smooth surface of
/// which only the corners are known, and flat facets stay flat. Edges that belong to a fold stay
/// straight there. Edges and parts keep their names and their extent.
/// @param mesh  made of `coarse`
/// @source Vlachos, Peters, Boyd, Mitchell (2001), curved point-normal patches, eq. (4); Coons
/// (1967)
Facets subdivide(const Facets& coarse, const ShellMesh& mesh, int refinement);

}  // namespace culm::shell
