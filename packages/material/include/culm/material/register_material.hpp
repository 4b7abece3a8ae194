/// What this package offers to the deck.
#pragma once

#include <culm/base/registry.hpp>
#include <culm/material/material.hpp>
#include <culm/material/section.hpp>

namespace culm::material {

/// Adds all section types.
void register_sections(Registry<Section>& registry);
/// Adds all material types.
void register_materials(Registry<Material>& registry);

}  // namespace culm::material
