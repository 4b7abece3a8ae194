#pragma once

#include <culm/joint/anchor.hpp>
#include <culm/joint/prescribed.hpp>
#include <culm/model/build_context.hpp>

namespace culm::joint {

/// Holds a point, p(phi) - p0 - u(t): three linear rows. Eliminated when the point is the node and
/// nothing moves.
/// @param offset  phi, in the directors of the point [m]
/// @source formulation 2.2 "sphericalsupport"
model::Constraint spherical_support(const Anchor& anchor, const Vec3& offset,
                                    const Translation& motion = {});

void register_spherical_support(model::BuilderRegistry& registry);

}  // namespace culm::joint
