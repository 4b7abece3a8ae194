// Small motions of the grid about a steady flow.
#include <culm/lattice/lattice.hpp>

#include <algorithm>

namespace culm::lattice {
namespace {

using Columns = Eigen::MatrixXd;

Points points_of(const Eigen::VectorXd& column) {
  Points points;
  for (Eigen::Index i = 0; i < column.size(); i += 3) points.push_back(column.segment<3>(i));
  return points;
}

Eigen::VectorXd column_of(const Points& points) {
  Eigen::VectorXd column(3 * static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    column.segment<3>(3 * static_cast<Eigen::Index>(i)) = points.at(i);
  }
  return column;
}

Points along(const Points& from, double way, const Points& by) {
  Points result = from;
  for (std::size_t i = 0; i < from.size(); ++i) result.add(i, way * by.at(i));
  return result;
}

// Ends of rows behind an edge, over the whole length: one panel each at first, then a share of the
// distance, over which circulations of motions that the wake still feels hardly change.
std::vector<double> ends_of_rows(double panel) {
  constexpr double growth = 0.05;
  std::vector<double> ends{0.0};
  while (ends.back() < 1.0) {
    ends.push_back(std::min(1.0, ends.back() + std::max(panel, growth * ends.back())));
  }
  return ends;
}

}  // namespace

// A row that the wind reaches between two times carries what the edge had half a step of one panel
// before their middle, as those of a motion in time do: the first vortex that is shed continues the
// pattern of the bound ones.
void Lattice::add_straight_rows(const Points& grid, double time, SmallMotions& small) const {
  const Points edges = bound_.edge_points(bound_.corners(grid));
  const Points far = far_line(edges, time), wind = flow_at(edges, time);
  const Points ways = along(far, -1.0, edges);
  const Points places = bound_.collocation_points(grid), normals = unit_normals(grid);
  for (const Panelling& s : bound_.surfaces()) {
    for (int j = 0; j < s.panels.span; ++j) {
      const std::size_t left = s.edge_point(j), right = s.edge_point(j + 1);
      const double speed = 0.5 * (wind.at(left).norm() + wind.at(right).norm());
      if (speed == 0.0) continue;
      const double length = 0.5 * (ways.at(left).norm() + ways.at(right).norm());
      const double panel = s.chord / s.panels.chord;
      small.passing += 0.5 * s.chord / speed / static_cast<double>(bound_.num_strips());
      small.panel = std::max(small.panel, panel / speed);
      const std::vector<double> ends = ends_of_rows(panel / length);
      for (std::size_t k = 1; k < ends.size(); ++k) {
        WakeRow row;
        row.edge_ring = static_cast<Eigen::Index>(s.ring(s.panels.chord - 1, j));
        row.delay = 0.5 * ((ends[k - 1] + ends[k]) * length + panel) / speed;
        row.induced.setZero(static_cast<Eigen::Index>(bound_.num_rings()));
        add_row(along(edges, ends[k - 1], ways), along(edges, ends[k], ways), s.strip(j), places,
                normals, {row.induced.data(), bound_.num_rings()});
        small.rows.push_back(std::move(row));
      }
    }
  }
}

SmallMotions Lattice::small_motions(const FluidResult& steady, const Points& grid, double time,
                                    const Eigen::MatrixXd& motions) const {
  const auto rings = static_cast<Eigen::Index>(bound_.num_rings());
  const Points normals = unit_normals(grid);
  SmallMotions small;
  small.influence.setZero(rings, rings);
  bound_.add_influence(bound_.segments(bound_.corners(grid)), bound_.collocation_points(grid),
                       normals, small.influence);
  add_straight_rows(grid, time, small);

  const Eigen::VectorXd none = Eigen::VectorXd::Zero(rings);
  Columns by_circulation(motions.rows(), rings), by_growth(motions.rows(), rings);
  for (Eigen::Index ring = 0; ring < rings; ++ring) {
    const Eigen::VectorXd one = Eigen::VectorXd::Unit(rings, ring);
    by_circulation.col(ring) = column_of(forces(grid, steady.at_forces, one, none));
    by_growth.col(ring) = column_of(forces(grid, steady.at_forces, none, one));
  }
  small.by_circulation = motions.transpose() * by_circulation;
  small.by_growth = motions.transpose() * by_growth;

  Columns by_place(motions.rows(), motions.cols()), by_velocity = by_place;
  small.flow_by_place.resize(rings, motions.cols());
  small.flow_by_velocity.resize(rings, motions.cols());
  for (Eigen::Index m = 0; m < motions.cols(); ++m) {
    const Points change = points_of(motions.col(m));
    const Points turned = change_of_normals(grid, change);
    const Points moved = bound_.collocation_points(change);
    for (Eigen::Index k = 0; k < rings; ++k) {
      const auto at = static_cast<std::size_t>(k);
      small.flow_by_place(k, m) = -steady.at_collocation.at(at).dot(turned.at(at));
      small.flow_by_velocity(k, m) = moved.at(at).dot(normals.at(at));
    }
    const Points against = along(Points(steady.at_forces.size()), -1.0, force_points(change));
    by_velocity.col(m) = column_of(forces(grid, against, steady.circulation, none));
    const auto beside = [&](double way) {
      return column_of(
          forces(along(grid, way, change), steady.at_forces, steady.circulation, none));
    };
    const double h = small_way(change);
    by_place.col(m).setZero();
    if (h > 0.0) by_place.col(m) = (beside(h) - beside(-h)) / (2.0 * h);
  }
  small.by_place = motions.transpose() * by_place;
  small.by_velocity = motions.transpose() * by_velocity;
  return small;
}

}  // namespace culm::lattice
