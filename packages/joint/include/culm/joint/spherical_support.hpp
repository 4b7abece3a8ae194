#pragma once

#include <culm/model/build_context.hpp>

namespace culm::joint {

/// Holds a point of a node, p(phi) - p0: three linear rows. Eliminated when the point is the node.
/// @param offset  phi, in the directors of the node [m]
/// @source formulation 2.2 "sphericalsupport"
model::Constraint spherical_support(const model::NodeTable& nodes, int node, const Vec3& offset);

void register_spherical_support(model::BuilderRegistry& registry);

}  // namespace culm::joint
