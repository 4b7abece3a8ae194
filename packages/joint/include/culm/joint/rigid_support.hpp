#pragma once

#include <culm/model/build_context.hpp>

namespace culm::joint {

/// Holds a node altogether: x - x0 and d_i - d_i0, twelve linear rows that imply the internal
/// ones. Eliminated. @source formulation 2.2 "rigidsupport"
model::Constraint rigid_support(const model::NodeTable& nodes, int node);

void register_rigid_support(model::BuilderRegistry& registry);

}  // namespace culm::joint
