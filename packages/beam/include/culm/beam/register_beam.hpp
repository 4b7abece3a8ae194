/// What this package offers to the deck.
#pragma once

#include <culm/structure/structure_context.hpp>

namespace culm::beam {

/// Adds the type "Beam" of the deck's list "Structures".
void register_beams(structure::StructureRegistry& registry);

}  // namespace culm::beam
