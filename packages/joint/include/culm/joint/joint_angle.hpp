#pragma once

#include <culm/joint/marker_pair.hpp>
#include <culm/joint/prescribed.hpp>

namespace culm::joint {

/// Prescribes the angle alpha(t) by which the second node of a revolute joint has turned about
/// `axis`, a unit vector in the reference, relative to the first: one product row,
///   u_1(e) . u_2(n1) = 0      e = -sin(alpha) n1 + cos(alpha) n2,
/// with n1 = pair.across(axis).
/// @param motion alpha [rad]
/// @source formulation 2.2, 2.7
model::Constraint joint_angle(const MarkerPair& pair, const Vec3& axis, const Prescribed& motion);

void register_joint_angle(model::BuilderRegistry& registry);

}  // namespace culm::joint
