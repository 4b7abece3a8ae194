#include <culm/lattice/bound_lattice.hpp>

#include <Eigen/Geometry>

#include <array>

namespace culm::lattice {
namespace {

Vec3 reflect(const Vec3& normal, const Vec3& p) { return p - 2.0 * normal.dot(p) * normal; }

Segments images(const Segments& segments, const Vec3& normal) {
  Segments result;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    result.push_back(reflect(normal, segments.from.at(s)), reflect(normal, segments.to.at(s)),
                     segments.core[s]);
  }
  return result;
}

// A weight per corner of a panel: (i, j), (i, j + 1), (i + 1, j), (i + 1, j + 1).
Points panel_points(const BoundLattice& lattice, const Points& grid, double ahead, double behind) {
  Points result(lattice.num_rings());
  for_each_panel(lattice, [&](const Panelling& s, int i, int j) {
    result.set(s.ring(i, j),
               0.5 * ahead * (grid.at(s.point(i, j)) + grid.at(s.point(i, j + 1))) +
                   0.5 * behind * (grid.at(s.point(i + 1, j)) + grid.at(s.point(i + 1, j + 1))));
  });
  return result;
}

// A corner is this combination of two grid points of its column.
struct CornerRule {
  int first;
  double weight_first, weight_second;  // of grid points `first` and `first` + 1
};

CornerRule corner_rule(int i, int chord) {
  if (i < chord) return {i, 0.75, 0.25};
  return {chord - 1, -0.25, 1.25};
}

template <class Visit>
void for_each_corner(const std::vector<Panelling>& surfaces, Visit visit) {
  for (const Panelling& s : surfaces) {
    for (int i = 0; i <= s.panels.chord; ++i) {
      const CornerRule rule = corner_rule(i, s.panels.chord);
      for (int j = 0; j <= s.panels.span; ++j) {
        visit(s.point(i, j), s.point(rule.first, j), s.point(rule.first + 1, j), rule);
      }
    }
  }
}

}  // namespace

BoundLattice::BoundLattice(const std::vector<Panels>& surfaces, const Points& reference,
                           std::optional<Vec3> mirror)
    : mirror_(std::move(mirror)) {
  for (const Panels& panels : surfaces) {
    Panelling s{panels, num_points_, num_rings_, num_segments_, num_edge_points_, num_strips_};
    const auto m = static_cast<std::size_t>(panels.chord);
    const auto n = static_cast<std::size_t>(panels.span);
    num_points_ += (m + 1) * (n + 1);
    num_rings_ += m * n;
    num_segments_ += (m + 1) * n + m * (n + 1);
    num_edge_points_ += n + 1;
    num_strips_ += n;
    for (int j = 0; j <= panels.span; ++j) {
      s.chord += (reference.at(s.point(panels.chord, j)) - reference.at(s.point(0, j))).norm() /
                 static_cast<double>(n + 1);
    }
    for (int j = 0; j < panels.span; ++j) {
      s.width += (reference.at(s.point(0, j + 1)) - reference.at(s.point(0, j))).norm() /
                 static_cast<double>(n);
    }
    surfaces_.push_back(s);
  }
}

Points BoundLattice::corners(const Points& grid) const {
  Points result(num_points_);
  for_each_corner(surfaces_, [&](std::size_t corner, std::size_t first, std::size_t second,
                                 const CornerRule& rule) {
    result.set(corner, rule.weight_first * grid.at(first) + rule.weight_second * grid.at(second));
  });
  return result;
}

void BoundLattice::add_corner_forces(const Points& at_corners, Points& at_grid) const {
  for_each_corner(surfaces_, [&](std::size_t corner, std::size_t first, std::size_t second,
                                 const CornerRule& rule) {
    at_grid.add(first, rule.weight_first * at_corners.at(corner));
    at_grid.add(second, rule.weight_second * at_corners.at(corner));
  });
}

Points BoundLattice::collocation_points(const Points& grid) const {
  return panel_points(*this, grid, 0.25, 0.75);
}

Points BoundLattice::centres(const Points& grid) const {
  return panel_points(*this, grid, 0.5, 0.5);
}

Points BoundLattice::edge_points(const Points& corners) const {
  Points result(num_edge_points_);
  for (const Panelling& s : surfaces_) {
    for (int j = 0; j <= s.panels.span; ++j) {
      result.set(s.edge_point(j), corners.at(s.point(s.panels.chord, j)));
    }
  }
  return result;
}

Points BoundLattice::areas(const Points& grid) const {
  Points result(num_rings_);
  for_each_panel(*this, [&](const Panelling& s, int i, int j) {
    const Vec3 first = grid.at(s.point(i + 1, j + 1)) - grid.at(s.point(i, j));
    const Vec3 second = grid.at(s.point(i, j + 1)) - grid.at(s.point(i + 1, j));
    result.set(s.ring(i, j), 0.5 * first.cross(second));
  });
  return result;
}

namespace {

// Calls visit(segment, from, to) with corners.
template <class Visit>
void for_each_segment(const std::vector<Panelling>& surfaces, Visit visit) {
  for (const Panelling& s : surfaces) {
    for (int i = 0; i <= s.panels.chord; ++i) {
      for (int j = 0; j < s.panels.span; ++j) {
        visit(s, s.across(i, j), s.point(i, j), s.point(i, j + 1));
      }
    }
    for (int i = 0; i < s.panels.chord; ++i) {
      for (int j = 0; j <= s.panels.span; ++j) {
        visit(s, s.along(i, j), s.point(i, j), s.point(i + 1, j));
      }
    }
  }
}

}  // namespace

Points BoundLattice::segment_middles(const Points& corners) const {
  Points result(num_segments_);
  for_each_segment(surfaces_,
                   [&](const Panelling&, std::size_t segment, std::size_t from, std::size_t to) {
                     result.set(segment, 0.5 * (corners.at(from) + corners.at(to)));
                   });
  return result;
}

Segments BoundLattice::segments(const Points& corners) const {
  Segments result;
  for_each_segment(surfaces_,
                   [&](const Panelling& s, std::size_t, std::size_t from, std::size_t to) {
                     result.push_back(corners.at(from), corners.at(to), s.bound_core());
                   });
  return result;
}

std::vector<double> BoundLattice::strengths(const Eigen::VectorXd& circulation) const {
  std::vector<double> result(num_segments_, 0.0);
  for_each_panel(*this, [&](const Panelling& s, int i, int j) {
    const double g = circulation[static_cast<Eigen::Index>(s.ring(i, j))];
    result[s.across(i, j)] += g;
    result[s.across(i + 1, j)] -= g;
    result[s.along(i, j + 1)] += g;
    result[s.along(i, j)] -= g;
  });
  return result;
}

std::vector<double> BoundLattice::edge_circulation(const Eigen::VectorXd& circulation) const {
  std::vector<double> result(num_strips_);
  for (const Panelling& s : surfaces_) {
    for (int j = 0; j < s.panels.span; ++j) {
      result[s.strip(j)] = circulation[static_cast<Eigen::Index>(s.ring(s.panels.chord - 1, j))];
    }
  }
  return result;
}

void BoundLattice::add_induced_normal(const Segments& segments, std::size_t segment, double factor,
                                      const Points& points, const Points& normals,
                                      std::span<double> column) const {
  add_normal_velocities(segments, segment, factor, points, normals, column);
  if (!mirror_) return;
  Segments one;
  one.push_back(reflect(*mirror_, segments.from.at(segment)),
                reflect(*mirror_, segments.to.at(segment)), segments.core[segment]);
  add_normal_velocities(one, 0, -factor, points, normals, column);
}

void BoundLattice::add_influence(const Segments& segments, const Points& points,
                                 const Points& normals, Eigen::MatrixXd& matrix) const {
  // each segment is evaluated once and belongs to at most two rings
  Eigen::VectorXd column(static_cast<Eigen::Index>(points.size()));
  const auto add = [&](std::size_t segment, std::array<std::optional<std::size_t>, 2> rings) {
    column.setZero();
    add_induced_normal(segments, segment, 1.0, points, normals, {column.data(), points.size()});
    if (rings[0]) matrix.col(static_cast<Eigen::Index>(*rings[0])) += column;
    if (rings[1]) matrix.col(static_cast<Eigen::Index>(*rings[1])) -= column;
  };
  for (const Panelling& s : surfaces_) {
    const auto [m, n] = s.panels;
    const auto ring = [&](int i, int j) -> std::optional<std::size_t> {
      if (i < 0 || j < 0 || i == m || j == n) return std::nullopt;
      return s.ring(i, j);
    };
    for (int i = 0; i <= m; ++i) {
      for (int j = 0; j < n; ++j) add(s.across(i, j), {ring(i, j), ring(i - 1, j)});
    }
    for (int i = 0; i < m; ++i) {
      for (int j = 0; j <= n; ++j) add(s.along(i, j), {ring(i, j - 1), ring(i, j)});
    }
  }
}

void BoundLattice::add_induced(const Segments& segments, std::span<const double> strengths,
                               const Points& points, Points& velocities) const {
  add_velocities(segments, strengths, points, velocities);
  if (!mirror_) return;
  std::vector<double> opposite(strengths.begin(), strengths.end());
  for (double& strength : opposite) strength = -strength;
  add_velocities(images(segments, *mirror_), opposite, points, velocities);
}

}  // namespace culm::lattice
