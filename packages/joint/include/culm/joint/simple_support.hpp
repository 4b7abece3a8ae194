#pragma once

#include <culm/joint/anchor.hpp>
#include <culm/joint/prescribed.hpp>
#include <culm/model/build_context.hpp>

namespace culm::joint {

/// Holds a point of a node in one direction of space, n . (p(phi) - p0) - u(t): one linear row.
/// Eliminated when n is a coordinate axis, the point is the node and nothing moves.
/// @param n       unit length
/// @param offset  phi, in the directors of the point [m]
/// @param motion  u [m]
/// @source formulation 2.2 "simplesupport_global"
model::Constraint simple_support(const Anchor& anchor, const Vec3& n, const Vec3& offset,
                                 const Prescribed& motion = {});

void register_simple_support(model::BuilderRegistry& registry);

}  // namespace culm::joint
