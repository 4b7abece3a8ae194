#pragma once

#include <culm/joint/anchor.hpp>
#include <culm/joint/prescribed.hpp>
#include <culm/model/build_context.hpp>

namespace culm::joint {

/// Holds a node in one direction that turns with it, u(nu) . (x - x0) - u(t): one product row.
/// @param n       the direction in the reference, unit length
/// @param motion  u [m]
/// @source formulation 2.2 "simplesupport_local"
model::Constraint simple_support_local(const Anchor& anchor, const Vec3& n,
                                       const Prescribed& motion = {});

void register_simple_support_local(model::BuilderRegistry& registry);

}  // namespace culm::joint
