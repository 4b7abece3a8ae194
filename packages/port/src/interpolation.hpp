/// Shape functions of the cells of structures.
#pragma once

#include <culm/math/types.hpp>

#include <Eigen/Core>

namespace culm::port {

/// What a cell is: it decides its natural coordinates and what an offset from it is made of.
enum class Shape {
  node,     ///< one node: none; offsets in its triad
  line,     ///< two to four nodes along a line: xi; offsets in d1, d2
  segment,  ///< two neighbouring nodes of a line, and their neighbours if there are any: the same
  surface,  ///< four nodes around a face: xi, eta; offsets along the director
};

/// Weights of the nodes of a cell and their derivatives by the natural coordinates, up to four
/// rows.
struct Interpolation {
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 4, 1>;
  Column N, N_xi, N_eta;
};

/// @param nodes    how many the cell has
/// @param natural  xi, eta, within the cell from -1 to 1; a surface has its nodes at (-1, -1), (1,
///                 -1), (1, 1), (-1, 1)
/// @pre not a segment
Interpolation interpolate(Shape shape, std::size_t nodes, const Eigen::Vector2d& natural);

/// Distances between the nodes of a segment; zero where there is no neighbour.
struct Spacing {
  double before = 0.0, within = 0.0, after = 0.0;  // [m]
};

/// Cubic weights on a segment: the curve goes through the nodes, and so does its tangent from one
/// segment to the next. Slopes at nodes are those of parabolas through three nodes; at the end of a
/// line the last piece is a parabola.
/// @source Catmull, Rom, in: Computer Aided Geometric Design (1974) 317-326, on uneven nodes
Interpolation interpolate(const Spacing& spacing, double xi);

}  // namespace culm::port
