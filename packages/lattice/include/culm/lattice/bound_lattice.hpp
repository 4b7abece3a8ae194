/// Vortex rings on lifting surfaces.
#pragma once

#include <culm/lattice/biot_savart.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace culm::lattice {

/// Numbers of panels of a surface.
struct Panels {
  int chord = 1;  ///< from the leading to the trailing edge
  int span = 1;
};

/// Where the parts of one surface stand among those of all. Points (i, j) go from the leading edge
/// i = 0 to the trailing edge i = chord, and along the span j = 0 ... span.
struct Panelling {
  Panels panels;
  std::size_t first_point = 0, first_ring = 0, first_segment = 0;
  std::size_t first_edge_point = 0, first_strip = 0;  ///< of the trailing edge
  double chord = 0.0;                                 ///< mean in the reference [m]
  double width = 0.0;                                 ///< mean span of a panel [m]

  /// Radius of the cores of bound segments: far below any distance that matters, and enough to keep
  /// points on a segment, or on its continuation, free of rounding [m].
  double bound_core() const { return 1e-4 * chord; }
  /// The smaller side of a panel [m].
  double side() const { return std::min(width, chord / panels.chord); }

  std::size_t point(int i, int j) const { return first_point + at(i, panels.span + 1, j); }
  std::size_t ring(int i, int j) const { return first_ring + at(i, panels.span, j); }
  /// The segment along the span from corner (i, j) to (i, j + 1), i = 0 ... chord.
  std::size_t across(int i, int j) const { return first_segment + at(i, panels.span, j); }
  /// The segment along the chord from corner (i, j) to (i + 1, j), j = 0 ... span.
  std::size_t along(int i, int j) const {
    return first_segment + at(panels.chord + 1, panels.span, 0) + at(i, panels.span + 1, j);
  }
  std::size_t edge_point(int j) const { return first_edge_point + static_cast<std::size_t>(j); }
  std::size_t strip(int j) const { return first_strip + static_cast<std::size_t>(j); }

 private:
  static std::size_t at(int i, int row, int j) { return static_cast<std::size_t>(i * row + j); }
};

/// Rings of several surfaces, stated as maps of their grid points, which lie on the structure. A
/// ring has its corners a quarter of a panel behind the points of the grid and its collocation
/// point at three quarters of the panel. Corners, middles and collocation points are linear in the
/// grid, so the same maps serve velocities. @source Katz, Plotkin, Low-Speed Aerodynamics, 12.3
class BoundLattice {
 public:
  /// @param reference  grid points of all surfaces, from which chords and widths are taken
  /// @param mirror  unit normal of a plane of symmetry through the origin
  BoundLattice(const std::vector<Panels>& surfaces, const Points& reference,
               std::optional<Vec3> mirror);

  const std::vector<Panelling>& surfaces() const { return surfaces_; }
  const std::optional<Vec3>& mirror() const { return mirror_; }
  std::size_t num_points() const { return num_points_; }
  std::size_t num_rings() const { return num_rings_; }
  std::size_t num_segments() const { return num_segments_; }
  std::size_t num_edge_points() const { return num_edge_points_; }  ///< of all trailing edges
  std::size_t num_strips() const { return num_strips_; }

  Points corners(const Points& grid) const;
  Points collocation_points(const Points& grid) const;
  Points centres(const Points& grid) const;  ///< of the panels
  Points segment_middles(const Points& corners) const;
  Points edge_points(const Points& corners) const;  ///< where wakes begin
  /// Unit normals times areas of the panels [m^2].
  Points areas(const Points& grid) const;

  Segments segments(const Points& corners) const;
  /// Differences of the circulations of adjacent rings [m^2/s], by segment.
  std::vector<double> strengths(const Eigen::VectorXd& circulation) const;
  /// Of the rings at the trailing edges, by strip.
  std::vector<double> edge_circulation(const Eigen::VectorXd& circulation) const;

  /// Adds to `matrix` the velocities along `normals` at points per circulation of each ring.
  void add_influence(const Segments& segments, const Points& points, const Points& normals,
                     Eigen::MatrixXd& matrix) const;
  /// Adds what segments and their images behind the mirror induce.
  void add_induced(const Segments& segments, std::span<const double> strengths,
                   const Points& points, Points& velocities) const;
  /// Adds to a column the same of one segment of unit strength times `factor`, along `normals`.
  void add_induced_normal(const Segments& segments, std::size_t segment, double factor,
                          const Points& points, const Points& normals,
                          std::span<double> column) const;

  /// Adds forces at corners, the transpose of `corners`, to those at grid points.
  void add_corner_forces(const Points& at_corners, Points& at_grid) const;

 private:
  std::vector<Panelling> surfaces_;
  std::optional<Vec3> mirror_;
  std::size_t num_points_ = 0, num_rings_ = 0, num_segments_ = 0;
  std::size_t num_edge_points_ = 0, num_strips_ = 0;
};

/// Calls visit(surface, i, j) for all panels.
template <class Visit>
void for_each_panel(const BoundLattice& lattice, Visit visit) {
  for (const Panelling& surface : lattice.surfaces()) {
    for (int i = 0; i < surface.panels.chord; ++i) {
      for (int j = 0; j < surface.panels.span; ++j) visit(surface, i, j);
    }
  }
}

}  // namespace culm::lattice
