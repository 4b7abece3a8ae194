/// Directions that winds are described in.
#pragma once

#include <culm/base/schema.hpp>
#include <culm/math/types.hpp>

namespace culm::flow {

/// Along the mean wind, across it (to the left, seen along the wind) and normal to both, unit
/// vectors; heights are measured from the origin of the deck along `up`.
struct WindAxes {
  Vec3 along, across, normal, up;

  double height(const Vec3& place) const { return up.dot(place); }
  /// The direction of a wind that is turned about `up` [rad], clockwise seen from above as
  /// OpenFAST's tables have it.
  Vec3 turned(double angle) const;
};

/// Parameters "Direction" and "Up", with the rule that they are not parallel.
Schema wind_axes_schema();
WindAxes read_wind_axes(const Options& options);

}  // namespace culm::flow
