/// Meshes of four-node shells: nodes with directors, elements, named edges and parts.
#pragma once

#include <culm/math/types.hpp>
#include <culm/shell/shell_forms.hpp>

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace culm::shell {

/// A corner of a quadrilateral.
struct Corner {
  int quad;
  int corner;  ///< 0 to 3
};

/// Quadrilaterals before they get directors. Points of neighbouring patches may lie twice.
struct Facets {
  std::vector<Vec3> points;
  std::vector<std::array<int, 4>> quads;             ///< counter-clockwise seen from outside
  std::vector<std::array<Vec3, 4>> normals;          ///< of the surface at the corners, length one
  std::map<std::string, std::vector<Corner>> edges;  ///< in order along the edge, ends of its sides
  std::set<std::string> points_only;                 ///< edges that are points, without lines
  std::map<std::string, std::vector<int>> parts;     ///< quads by name
  std::vector<int> parents;  ///< number of the quad before refinement, by quad; may be empty

  /// Adds all of another set; edges and parts of the same name are joined.
  void append(const Facets& other);
};

/// With which of an edge each of its corners makes a side: they come in pairs, between which may be
/// corners of the other quadrilaterals along the side. -1 for one that is left over.
std::vector<int> partners_along(const std::vector<Corner>& edge);

/// A mesh of shell elements.
struct ShellMesh {
  std::vector<Vec3> positions;
  std::vector<Vec3> directors;  ///< length one
  std::vector<std::array<int, 4>> quads;
  std::map<std::string, std::vector<int>> edges;  ///< nodes in order along the edge
  /// Both ends of each side along it; of a fold, where two elements have one, that of the first.
  std::map<std::string, std::vector<std::array<int, 2>>> sides;
  std::map<std::string, std::vector<int>> parts;  ///< elements by name
  /// Nodes at one place with different directors, at folds and where more than two walls meet.
  std::vector<std::vector<int>> folds;
  int fold_lines = 0;              ///< lines of edges along them that hang together
  double smallest_fold_angle = 0;  ///< between normals at a folded edge [rad]; 0 without folds
  /// Elements, by number, whose only neighbour at an edge runs it in the same direction: one of
  /// them has its normal on the other side.
  std::vector<int> turned;

  int size() const { return static_cast<int>(positions.size()); }
  /// x, d of the nodes of an element
  ShellForms::Nodes slots(int quad) const;
};

/// Normals at the corners of a quadrilateral by its own edges, for surfaces known by points only.
std::array<Vec3, 4> corner_normals(const std::array<Vec3, 4>& points);

/// Joins points that lie together, and gives each node the mean of the normals around it. Elements
/// that share an edge share its nodes unless their normals there differ by more than `fold_angle`
/// [rad]; then each side has its own node.
ShellMesh make_mesh(const Facets& facets, double fold_angle);

/// How good a mesh is.
struct MeshQuality {
  double largest_aspect = 1.0;  ///< longest over shortest edge of an element
  double smallest_angle = 0.0;  ///< inner angle of a corner [rad]
  double largest_angle = 0.0;   ///< [rad]
  double largest_warp = 0.0;    ///< between the normals at the corners of an element [rad]
  /// Estimate of the share of the volume that elements lack of a curved wall: at an angle x between
  /// directors and the normals of elements, which are chords, 1 - cos x sin x / x.
  double missing_volume = 0.0;
};

MeshQuality mesh_quality(const ShellMesh& mesh);

}  // namespace culm::shell
