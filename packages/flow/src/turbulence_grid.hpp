/// Velocities on a grid of points that moves with the mean wind.
#pragma once

#include <culm/base/issue.hpp>
#include <culm/math/types.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace culm::flow {

/// Velocities of planes normal to the mean wind: along it, across it to the left, and upwards.
/// Values stand as in files of TurbSim: component fastest, then across, then upwards, then planes.
struct TurbulenceGrid {
  std::array<int, 2> points{};      ///< across, upwards; at least two each
  std::array<double, 2> spacing{};  ///< likewise [m]
  int planes = 0;
  double interval = 0.0;      ///< between planes [s]
  double speed = 0.0;         ///< with which planes move [m/s]
  bool periodic = false;      ///< the first plane follows the last one
  std::vector<float> values;  ///< [m/s]

  double width() const { return (points[0] - 1) * spacing[0]; }
  double height() const { return (points[1] - 1) * spacing[1]; }
  /// Duration that is known [s].
  double duration() const { return (periodic ? planes : planes - 1) * interval; }
  /// The velocity at a place, linear between points.
  /// @param across, up  from the lower right corner, seen along the wind; from 0 to the sizes [m]
  /// @param time        from 0 to duration() [s]
  Vec3 at(double across, double up, double time) const;
  /// Its derivatives, columns by `across`, `up` [1/s] and `time` [m/s^2].
  Mat3 slope_at(double across, double up, double time) const;
};

}  // namespace culm::flow
