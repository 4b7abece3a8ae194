#pragma once

#include <culm/joint/node_pair.hpp>

namespace culm::joint {

/// Joins a point of two nodes: three rows. @source formulation 2.2
model::Constraint spherical_joint(const NodePair& pair);

void register_spherical_joint(model::BuilderRegistry& registry);

}  // namespace culm::joint
