#pragma once

#include <culm/joint/anchor.hpp>
#include <culm/model/build_context.hpp>

namespace culm::joint {

/// Keeps a node in a plane: n . (x - x0) and u(n) . e for two directions e in the plane, three
/// linear rows; a node of a shell by n . (x - x0) and n . (d - d0), two rows. This is also what
/// holds in a plane of symmetry. Eliminated when n is a coordinate axis.
/// @param normal  n, unit length
model::Constraint planar_support(const Anchor& anchor, const Vec3& normal);

/// Planar Support, Symmetry.
void register_planar_support(model::BuilderRegistry& registry);

}  // namespace culm::joint
