#pragma once

#include <culm/model/build_context.hpp>

namespace culm::joint {

/// All types of the deck's list "Constraints". Each adds one constraint per selected node.
void register_joints(model::BuilderRegistry& registry);

}  // namespace culm::joint
