/// Displacements and velocities at the start.
#pragma once

#include <culm/model/build_context.hpp>

namespace culm::model {

/// Types of the deck's list "Initial Conditions".
void register_initial_motions(BuilderRegistry& registry);

}  // namespace culm::model
