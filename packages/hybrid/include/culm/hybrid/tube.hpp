/// The structure type "Tube" of the deck: one geometry, a beam or a shell.
#pragma once

#include <culm/structure/structure_context.hpp>

namespace culm::hybrid {

/// Adds "Tube": a straight circular tube of an isotropic material. As a shell it has two more
/// structures, "NAME first" and "NAME last", nodes with directors that its ends follow; in both
/// models "NAME/first" and "NAME/last" are the nodes to hold, load and watch.
void register_hybrids(structure::StructureRegistry& registry);

}  // namespace culm::hybrid
