#pragma once

#include <culm/joint/marker_pair.hpp>

namespace culm::joint {

/// A hinge about `axis`, a unit vector in the reference: five rows. @source formulation 2.2
model::Constraint revolute_joint(const MarkerPair& pair, const Vec3& axis);

void register_revolute_joint(model::BuilderRegistry& registry);

}  // namespace culm::joint
