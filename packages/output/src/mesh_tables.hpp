/// Meshes and states as flat tables of numbers.
#pragma once

#include <culm/output/picture_mesh.hpp>

#include <string>
#include <vector>

namespace culm::output {

/// Coordinates point after point; shape (3 points).
std::vector<double> flatten(const std::vector<Vec3>& points);

/// Column `number` (1, 2, 3) of each triad; shape (3 triads).
std::vector<double> flatten_director(const std::vector<Mat3>& triads, int number);

/// Differences state - reference; shape (3 points).
std::vector<double> flatten_difference(const std::vector<Vec3>& state,
                                       const std::vector<Vec3>& reference);

/// Rows after each other.
std::vector<double> flatten_rows(const std::vector<std::vector<double>>& rows);

/// Cells in the compressed form of VTK: end of each cell in `connectivity`, VTK cell type.
struct CellTable {
  std::vector<int> connectivity;
  std::vector<int> offsets;
  std::vector<int> types;
};

CellTable cell_table(const std::vector<Cell>& cells);

/// Outlines without repetition: those of neighbours along a beam are mostly alike.
struct OutlineTable {
  std::vector<int> of_node;    ///< number of its outline; -1 for none
  std::vector<int> ends;       ///< end of each outline in `points`
  std::vector<double> points;  ///< shape (points, 2) [m]
};

OutlineTable outline_table(const std::vector<std::vector<Eigen::Vector2d>>& outlines);

/// Cells as a mixed topology of XDMF: per cell its type, for lines the count, then the nodes.
std::vector<int> xdmf_topology(const std::vector<Cell>& cells);

}  // namespace culm::output
