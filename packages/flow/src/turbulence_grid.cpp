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
};

}  // namespace

Vec3 TurbulenceGrid::at(double across, double up, double time) const {
  const Between y(across / spacing[0], points[0]);
  const Between z(up / spacing[1], points[1]);
  // a periodic grid has its first plane once more
  const Between t(time / interval, periodic ? planes + 1 : planes);
  const auto ny = static_cast<std::size_t>(points[0]);
  const auto nz = static_cast<std::size_t>(points[1]);
  Vec3 result = Vec3::Zero();
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::size_t dy = corner & 1U;
    const std::size_t dz = (corner >> 1U) & 1U;
    const std::size_t dt = corner >> 2U;
    const double weight = y.weight(dy) * z.weight(dz) * t.weight(dt);
    const std::size_t plane = (t.low + dt) % static_cast<std::size_t>(planes);
    const std::size_t first = 3 * ((plane * nz + z.low + dz) * ny + y.low + dy);
    for (int c = 0; c < 3; ++c) result[c] += weight * values[first + static_cast<std::size_t>(c)];
  }
  return result;
}

}  // namespace culm::flow
