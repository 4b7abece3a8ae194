/// What this package offers to the deck.
#pragma once

#include <culm/model/build_context.hpp>
#include <culm/structure/structure_context.hpp>

namespace culm::body {

/// Rigid bodies for the deck's list "Structures": by mass and inertia, and by solid shapes.
void register_bodies(structure::StructureRegistry& registry);
/// Types of the deck's list "Masses".
void register_masses(model::BuilderRegistry& registry);

}  // namespace culm::body
