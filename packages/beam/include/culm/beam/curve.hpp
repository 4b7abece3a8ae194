/// Smooth curves by arc length: the axes that decks describe by geometry.
#pragma once

#include <culm/math/types.hpp>

#include <functional>
#include <vector>

namespace culm::beam {

/// A smooth curve. Arc length s runs from 0 to `length`.
struct Curve {
  double length = 0.0;                   ///< [m]
  std::function<Vec3(double)> position;  ///< of s [m]
  std::function<Vec3(double)> tangent;   ///< of s; unit vector
  Vec3 normal = Vec3::Zero();            ///< never parallel to the curve: d1 unless told otherwise
};

/// Straight line; its normal is the coordinate axis least aligned with it.
/// @pre from != to
Curve line(const Vec3& from, const Vec3& to);

/// Screw motion of a point: `start` turns about the axis by `angle` [rad] and advances along it by
/// `pitch` [m] per turn, forward for positive angles. Zero pitch is a circular arc. The normal is
/// the axis.
/// @pre `start` is not on the axis; angle != 0
Curve helix(const Vec3& centre, const Vec3& axis, const Vec3& start, double angle, double pitch);

/// Natural cubic spline through points; its normal is the coordinate axis least aligned with the
/// line between its ends. @pre at least two points, neighbours and ends differ
Curve spline(const std::vector<Vec3>& points);

/// Circular arc from a through b to c. @pre the points are not on a line
Curve arc_through(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace culm::beam
