/// What springs, dampers and drives act on: a number that says how far points or axes are apart.
#pragma once

#include <culm/joint/marker_pair.hpp>
#include <culm/model/constraint.hpp>

#include <array>
#include <vector>

namespace culm::load {

/// How the coordinate z follows from the forms y of a link.
enum class Measure {
  component,  ///< z = y
  distance,   ///< z = sqrt(y)
  radius,     ///< z = |(y1, y2)|
  angle,      ///< z = atan2(y2, y1), unwrapped
};

/// (p + sum_s alpha_s q_s) . (w + sum_s beta_s q_s); a sum may be empty.
struct LinkForm {
  model::SlotSum alpha;
  Vec3 p = Vec3::Zero();
  model::SlotSum beta;
  Vec3 w = Vec3::Zero();
};

/// Quadratic forms of the slots of one or two nodes, and u = z(y) - rest.
struct Link {
  std::vector<int> nodes;
  Measure measure = Measure::component;
  std::vector<LinkForm> forms;  ///< two of radius and angle, one else
  double rest = 0.0;            ///< z where u = 0
};

/// A point fixed to a node.
struct LinkPoint {
  int node = -1;
  Vec3 offset = Vec3::Zero();  ///< in its directors [m]
};

/// Where a link begins and ends in the reference; the same place twice of one that acts at a node.
/// @param scale  by which its forms were divided
std::array<Vec3, 2> reference_ends(const model::NodeTable& nodes, const Link& link,
                                   double scale = 1.0);

/// Where a point is in the reference.
Vec3 reference_of(const model::NodeTable& nodes, const LinkPoint& point);

/// u = |p_2 - p_1| - rest, with the distance in the reference as rest.
Link distance_link(const model::NodeTable& nodes, const LinkPoint& first, const LinkPoint& second);
/// u = n . (p_2 - p_1) less its reference value, with n fixed in space or in the first node.
Link directed_link(const model::NodeTable& nodes, const LinkPoint& first, const LinkPoint& second,
                   const Vec3& n, bool follows);

/// u = |p - anchor| - rest, with the distance in the reference as rest.
Link ground_link(const model::NodeTable& nodes, const LinkPoint& point, const Vec3& anchor);
/// u = n . (p - p0), with n fixed in space or in the node.
Link directed_ground_link(const model::NodeTable& nodes, const LinkPoint& point, const Vec3& n,
                          bool follows);
/// u = |Pi (p - p0)|, Pi the projection on the plane normal to n.
Link plane_ground_link(const model::NodeTable& nodes, const LinkPoint& point, const Vec3& n);

/// Angle by which the second node has turned about `axis` relative to the first, zero in the
/// reference, counting full turns: atan2(u_1(n2) . u_2(n1), u_1(n1) . u_2(n1)), n1 =
/// pair.across(axis).
/// @source formulation 2.2
Link angle_link(const joint::MarkerPair& pair, const Vec3& axis);

}  // namespace culm::load
