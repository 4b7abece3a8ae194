#include "placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace culm::lattice {
namespace {

// shares of a chord, and of the smaller side of a panel
constexpr double in_the_plane = 1e-6;
constexpr double same_place = 1e-3;

// Distances from the plane of symmetry.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Range range_of(const Panelling& surface, const Points& grid, const Vec3& normal) {
  Range range;
  for (int i = 0; i <= surface.panels.chord; ++i) {
    for (int j = 0; j <= surface.panels.span; ++j) {
      const double distance = normal.dot(grid.at(surface.point(i, j)));
      range.low = std::min(range.low, distance);
      range.high = std::max(range.high, distance);
    }
  }
  return range;
}

// A half whose root is not normal to the plane, as with dihedral, has parts of a cambered or
// twisted root on the other side.
std::string cure_of_crossing(const Range& range) {
  constexpr double little = 0.1;
  const double beyond = std::min(-range.low, range.high);
  if (beyond > little * std::max(-range.low, range.high)) {
    return "of a whole wing and its image one half is meant";
  }
  return fmt::format(
      "a half whose root is inclined to the plane leads across it by its camber or twist; begin it "
      "{:.2g} m further out, which matters little beside a panel's span",
      beyond);
}

std::optional<Misplaced> find_beyond_mirror(const BoundLattice& lattice, const Points& grid,
                                            const std::vector<std::string>& names) {
  double side = 0.0;  // the sign of that on which the first surface stands
  for (std::size_t s = 0; s < lattice.surfaces().size(); ++s) {
    const double tolerance = in_the_plane * lattice.surfaces()[s].chord;
    const Range range = range_of(lattice.surfaces()[s], grid, *lattice.mirror());
    if (range.low >= -tolerance && range.high <= tolerance)
      return Misplaced{s, "lies in the plane of symmetry, where it meets its own image"};
    if (range.low < -tolerance && range.high > tolerance) {
      return Misplaced{s, fmt::format("crosses the plane of symmetry, from {:.4g} to {:.4g} m "
                                      "along its normal: {}",
                                      range.low, range.high, cure_of_crossing(range))};
    }
    const double here = range.high > tolerance ? 1.0 : -1.0;
    if (side != 0.0 && here != side) {
      return Misplaced{s,
                       "stands on the other side of the plane of symmetry than '" + names[0] + "'"};
    }
    side = here;
  }
  return {};
}

std::optional<Misplaced> find_repeated(const BoundLattice& lattice, const Points& grid,
                                       const std::vector<std::string>& names) {
  const Points places = lattice.collocation_points(grid);
  const std::vector<Panelling>& surfaces = lattice.surfaces();
  for (std::size_t b = 1; b < surfaces.size(); ++b) {
    const std::size_t end_b = b + 1 < surfaces.size() ? surfaces[b + 1].first_ring : places.size();
    for (std::size_t a = 0; a < b; ++a) {
      const double near = same_place * std::min(surfaces[a].side(), surfaces[b].side());
      for (std::size_t p = surfaces[a].first_ring; p < surfaces[a + 1].first_ring; ++p) {
        for (std::size_t q = surfaces[b].first_ring; q < end_b; ++q) {
          const Vec3 gap = places.at(p) - places.at(q);
          if (gap.norm() > near) continue;
          return Misplaced{b, fmt::format("has a panel in the same place as '{}', at {{{:.4g}, "
                                          "{:.4g}, {:.4g}}} m",
                                          names[a], places.x[q], places.y[q], places.z[q])};
        }
      }
    }
  }
  return {};
}

}  // namespace

std::optional<Misplaced> find_misplaced(const BoundLattice& lattice, const Points& grid,
                                        const std::vector<std::string>& names) {
  if (lattice.mirror()) {
    if (auto found = find_beyond_mirror(lattice, grid, names)) return found;
  }
  return find_repeated(lattice, grid, names);
}

}  // namespace culm::lattice
