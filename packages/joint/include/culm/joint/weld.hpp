#pragma once

#include <culm/joint/node_pair.hpp>

namespace culm::joint {

/// Joins two nodes rigidly by six rows. @source formulation 2.2
model::Constraint weld(const NodePair& pair);

void register_weld(model::BuilderRegistry& registry);

}  // namespace culm::joint
