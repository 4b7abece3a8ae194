/// Velocities that straight vortex segments induce.
#pragma once

#include <culm/lattice/points.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace culm::lattice {

/// Straight vortex segments, each from one point to another.
struct Segments {
  Points from, to;
  std::vector<double> core;  ///< r_c, the radius below which the velocity falls off [m]

  std::size_t size() const { return core.size(); }
  void clear() {
    from.clear();
    to.clear();
    core.clear();
  }
  void push_back(const Vec3& a, const Vec3& b, double radius) {
    from.push_back(a);
    to.push_back(b);
    core.push_back(radius);
  }
};

/// Adds to `velocities` what segments with the circulations `strengths` [m^2/s] induce at points:
///   v = G / (4 pi) (r1 + r2) (r1 x r2) / sqrt(D^2 + (r_c r0)^4 / 4)
///   D = r1 r2 (r1 r2 + r1 . r2)
/// with r1, r2 from both ends to the point and r0 the length. Where the segment is long,
/// D = (h r0)^2 / 2 at the distance h, so this is the core of Vatistas, h^2 / sqrt(h^4 + r_c^4),
/// but it is finite everywhere for r_c > 0. Each point sums over the segments in their order.
/// Values are not checked: not a number goes through.
/// @source van Garrel, Development of a wind turbine aerodynamics simulation module, 2003;
/// Vatistas, Kozel, Mih, A simpler model for concentrated vortices, 1991
void add_velocities(const Segments& segments, std::span<const double> strengths,
                    const Points& points, Points& velocities);

/// Adds to `sums`, one per point, `factor` times the component along `normals` of what one segment
/// of unit circulation induces.
void add_normal_velocities(const Segments& segments, std::size_t segment, double factor,
                           const Points& points, const Points& normals, std::span<double> sums);

}  // namespace culm::lattice
