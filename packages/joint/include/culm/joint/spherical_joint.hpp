#pragma once

#include <culm/joint/marker_pair.hpp>

namespace culm::joint {

/// Joins a point of two nodes: three rows. @source formulation 2.2
model::Constraint spherical_joint(const MarkerPair& pair);

void register_spherical_joint(model::BuilderRegistry& registry);

}  // namespace culm::joint
