#pragma once

#include <culm/joint/anchor.hpp>
#include <culm/model/build_context.hpp>

namespace culm::joint {

/// Holds a point of a node and leaves the rotation about one axis: p(phi) - p0 and u(n) . e for
/// two directions e normal to the axis, five linear rows. Eliminated when the axis is a coordinate
/// axis and the point is the node. A node of a shell keeps n . (d - d0) instead, one row.
/// @param axis    n, unit length
/// @param offset  phi, in the directors of the point [m]
model::Constraint revolute_support(const Anchor& anchor, const Vec3& axis, const Vec3& offset);

void register_revolute_support(model::BuilderRegistry& registry);

}  // namespace culm::joint
