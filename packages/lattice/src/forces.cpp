// Forces of the lattice on its grid points.
#include <culm/lattice/lattice.hpp>

#include <Eigen/Geometry>

#include <array>
#include <cmath>

namespace culm::lattice {
namespace {

void spread(Points& forces, const Vec3& force, const std::array<std::size_t, 4>& points) {
  for (const std::size_t point : points) forces.add(point, 0.25 * force);
}

bool touches_mirror(const BoundLattice& bound, const Panelling& surface, const Vec3& point) {
  return bound.mirror() && std::abs(bound.mirror()->dot(point)) < 1e-6 * surface.width;
}

}  // namespace

// The rate of the circulation is the inertia of the air: rho dG/dt A n at the centre of each panel.
Points Lattice::forces(const Points& grid, const Points& relative,
                       const Eigen::VectorXd& circulation, const Eigen::VectorXd& rate) const {
  Points result(bound_.num_points());
  if (setting_.forces == ForceRule::joukowski) {
    add_joukowski(grid, relative, circulation, result);
  } else {
    add_bernoulli(grid, relative, circulation, result);
  }
  const Points areas = bound_.areas(grid);
  for_each_panel(bound_, [&](const Panelling& s, int i, int j) {
    const std::size_t ring = s.ring(i, j);
    spread(result, flow_->density() * rate[static_cast<Eigen::Index>(ring)] * areas.at(ring),
           {s.point(i, j), s.point(i, j + 1), s.point(i + 1, j), s.point(i + 1, j + 1)});
  });
  return result;
}

// F = rho G w x l on all segments but those at the trailing edges, where the wake takes over, and
// those in the mirror, which are no vortices: what comes from both sides is nothing.
void Lattice::add_joukowski(const Points& grid, const Points& relative,
                            const Eigen::VectorXd& circulation, Points& forces) const {
  const Points corners = bound_.corners(grid);
  const std::vector<double> strengths = bound_.strengths(circulation);
  Points at_corners(bound_.num_points());
  const auto add = [&](std::size_t segment, std::size_t from, std::size_t to) {
    const Vec3 length = corners.at(to) - corners.at(from);
    const Vec3 half =
        0.5 * flow_->density() * strengths[segment] * relative.at(segment).cross(length);
    at_corners.add(from, half);
    at_corners.add(to, half);
  };
  for (const Panelling& s : bound_.surfaces()) {
    for (int i = 0; i < s.panels.chord; ++i) {
      for (int j = 0; j < s.panels.span; ++j) add(s.across(i, j), s.point(i, j), s.point(i, j + 1));
      for (int j = 0; j <= s.panels.span; ++j) {
        const std::size_t from = s.point(i, j), to = s.point(i + 1, j);
        if (touches_mirror(bound_, s, corners.at(from)) &&
            touches_mirror(bound_, s, corners.at(to))) {
          continue;
        }
        add(s.along(i, j), from, to);
      }
    }
  }
  bound_.add_corner_forces(at_corners, forces);
}

// The jump of the pressure by the mean flow along the panel, at the middle of its bound segment.
void Lattice::add_bernoulli(const Points& grid, const Points& relative,
                            const Eigen::VectorXd& circulation, Points& forces) const {
  const Points areas = bound_.areas(grid);
  Points at_corners(bound_.num_points());
  for_each_panel(bound_, [&](const Panelling& s, int i, int j) {
    // beyond a side of the surface there is nothing, beyond the mirror the same again
    const auto value = [&](int a, int b) {
      if (a < 0) return 0.0;
      const int side = b < 0 ? 0 : s.panels.span;
      if (b < 0 || b == s.panels.span) {
        if (!touches_mirror(bound_, s, grid.at(s.point(a, side)))) return 0.0;
        b = j;
      }
      return circulation[static_cast<Eigen::Index>(s.ring(a, b))];
    };
    const std::size_t ring = s.ring(i, j);
    const Vec3 front = grid.at(s.point(i, j)) + grid.at(s.point(i, j + 1));
    const Vec3 back = grid.at(s.point(i + 1, j)) + grid.at(s.point(i + 1, j + 1));
    const Vec3 left = grid.at(s.point(i, j)) + grid.at(s.point(i + 1, j));
    const Vec3 right = grid.at(s.point(i, j + 1)) + grid.at(s.point(i + 1, j + 1));
    const Vec3 along = 0.5 * (back - front), across = 0.5 * (right - left);
    const Vec3 wind = relative.at(ring);
    const double jump =
        wind.dot(along) / along.squaredNorm() * (value(i, j) - value(i - 1, j)) +
        wind.dot(across) / across.squaredNorm() * 0.5 * (value(i, j + 1) - value(i, j - 1));
    const Vec3 half = 0.5 * flow_->density() * jump * areas.at(ring);
    at_corners.add(s.point(i, j), half);
    at_corners.add(s.point(i, j + 1), half);
  });
  bound_.add_corner_forces(at_corners, forces);
}

}  // namespace culm::lattice
