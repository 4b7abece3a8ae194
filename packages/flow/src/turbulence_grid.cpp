#include "turbulence_grid.hpp"

#include <algorithm>
#include <cmath>

namespace culm::flow {
namespace {

// The point below a place in units of the spacing, and the share of the one above it.
struct Between {
  std::size_t low;
  double share;

  Between(double place, int points)
      : low(static_cast<std::size_t>(
            std::clamp(std::floor(place), 0.0, static_cast<double>(points - 2)))),
        share(place - static_cast<double>(low)) {}
  double weight(std::size_t side) const { return side == 0 ? 1.0 - share : share; }
  // Its derivative by the place.
  static double slope(std::size_t side) { return side == 0 ? -1.0 : 1.0; }
};

// The eight points around a place and a time of a grid.
struct Corners {
  Between y, z, t;

  Corners(const TurbulenceGrid& grid, double across, double up, double time)
      : y(across / grid.spacing[0], grid.points[0]),
        z(up / grid.spacing[1], grid.points[1]),
        // a periodic grid has its first plane once more
        t(time / grid.interval, grid.periodic ? grid.planes + 1 : grid.planes) {}

  // Calls use(side across, side upwards, side in time, velocity) for each.
  template <class Use>
  void for_each(const TurbulenceGrid& grid, const Use& use) const {
    const auto ny = static_cast<std::size_t>(grid.points[0]);
    const auto nz = static_cast<std::size_t>(grid.points[1]);
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const std::size_t dy = corner & 1U;
      const std::size_t dz = (corner >> 1U) & 1U;
      const std::size_t dt = corner >> 2U;
      const std::size_t plane = (t.low + dt) % static_cast<std::size_t>(grid.planes);
      const float* u = grid.values.data() + 3 * ((plane * nz + z.low + dz) * ny + y.low + dy);
      use(dy, dz, dt, Vec3(u[0], u[1], u[2]));
    }
  }
};

}  // namespace

Vec3 TurbulenceGrid::at(double across, double up, double time) const {
  const Corners corners(*this, across, up, time);
  Vec3 result = Vec3::Zero();
  corners.for_each(*this, [&](std::size_t dy, std::size_t dz, std::size_t dt, const Vec3& u) {
    result += corners.y.weight(dy) * corners.z.weight(dz) * corners.t.weight(dt) * u;
  });
  return result;
}

Mat3 TurbulenceGrid::slope_at(double across, double up, double time) const {
  const Corners corners(*this, across, up, time);
  Mat3 result = Mat3::Zero();
  corners.for_each(*this, [&](std::size_t dy, std::size_t dz, std::size_t dt, const Vec3& u) {
    const double y = corners.y.weight(dy), z = corners.z.weight(dz), t = corners.t.weight(dt);
    result.col(0) += Between::slope(dy) / spacing[0] * z * t * u;
    result.col(1) += Between::slope(dz) / spacing[1] * y * t * u;
    result.col(2) += Between::slope(dt) / interval * y * z * u;
  });
  return result;
}

}  // namespace culm::flow
