#pragma once

#include <culm/joint/marker_pair.hpp>

namespace culm::joint {

/// Slides along `axis`, a unit vector in the reference: five rows. @source formulation 2.2
model::Constraint prismatic_joint(const MarkerPair& pair, const Vec3& axis);

void register_prismatic_joint(model::BuilderRegistry& registry);

}  // namespace culm::joint
