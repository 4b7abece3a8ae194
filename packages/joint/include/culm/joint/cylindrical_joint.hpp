#pragma once

#include <culm/joint/marker_pair.hpp>

namespace culm::joint {

/// Slides along and turns about `axis`, a unit vector in the reference: four rows. @source
/// formulation 2.2
model::Constraint cylindrical_joint(const MarkerPair& pair, const Vec3& axis);

void register_cylindrical_joint(model::BuilderRegistry& registry);

}  // namespace culm::joint
