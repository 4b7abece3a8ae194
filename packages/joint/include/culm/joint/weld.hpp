#pragma once

#include <culm/joint/marker_pair.hpp>

namespace culm::joint {

/// Joins two nodes rigidly by six rows. @source formulation 2.2
model::Constraint weld(const MarkerPair& pair);

void register_weld(model::BuilderRegistry& registry);

}  // namespace culm::joint
