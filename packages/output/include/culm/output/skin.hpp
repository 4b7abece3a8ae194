#pragma once

#include <culm/output/picture_mesh.hpp>

#include <vector>

namespace culm::output {

/// The surface of a structure of lines: the cross-section outlines of consecutive nodes joined by
/// quadrilaterals, closed by a cap where a line ends. Topology only; points() gives it a shape.
class Skin {
 public:
  struct Face {
    std::vector<int> points;  ///< in circular order
    int cell;                 ///< the cell of the mesh that it belongs to
  };

  /// Lines whose nodes lack an outline, or have outlines of different numbers of points, get none.
  explicit Skin(const StructureMesh& mesh);

  bool empty() const { return faces_.empty(); }
  const std::vector<Face>& faces() const { return faces_; }

  /// x + ξ1 d1 + ξ2 d2 for all outline points of all nodes on skinned lines; m.
  /// @param positions, triads  per node of the mesh
  std::vector<Vec3> points(const std::vector<Vec3>& positions,
                           const std::vector<Mat3>& triads) const;

 private:
  void add_sides(const Cell& line, int cell);
  void add_cap(int node, int cell, bool at_start);
  bool has_outlines(const Cell& line) const;

  std::vector<std::vector<Eigen::Vector2d>> outlines_;  // per node; empty where not skinned
  std::vector<int> first_point_;                        // per node
  std::vector<Face> faces_;
};

}  // namespace culm::output
