#pragma once

#include <culm/joint/anchor.hpp>
#include <culm/joint/prescribed.hpp>
#include <culm/model/build_context.hpp>

namespace culm::joint {

/// Turns a node by alpha(t) about an axis fixed in space and leaves the other rotations free: one
/// linear row, with c0 a body vector normal to the axis in the reference,
///   e(t) . u(c0) = 0      e = -sin(alpha) c0 + cos(alpha) n x c0.
/// Singular where u(c0) is parallel to the axis. @source formulation 2.3
/// @param axis   n, unit length
/// @param motion alpha [rad]
model::Constraint rotation(const Anchor& anchor, const Vec3& axis, const Prescribed& motion);

/// The same about an axis fixed in the body, with c0 fixed in space:
///   c0 . u(e_b) = 0      e_b: sin(alpha) c0 + cos(alpha) n x c0 in the reference.
model::Constraint rotation_local(const Anchor& anchor, const Vec3& axis, const Prescribed& motion);

/// Rotation, Rotation Local
void register_rotation(model::BuilderRegistry& registry);

}  // namespace culm::joint
