/// Shell meshes of Gmsh.
#pragma once

#include <culm/shell/shell_mesh.hpp>

#include <string>

namespace culm::shell {

/// Reads a mesh of four-node quadrilaterals in the format MSH 2.2 or 4.1, ASCII. Physical surfaces
/// become parts, physical curves and points become edges, by their names, or by their numbers if
/// they have none; a curve along a fold has the nodes of both sides. Normals are those of the
/// elements, on the side that Gmsh gives them.
/// @param text  contents of the file
/// @param path  for messages
/// Throws FileError with the line for what is no such mesh: other formats, triangles, elements of
/// higher order, unknown nodes.
Facets read_gmsh(const std::string& text, const std::string& path);

}  // namespace culm::shell
