/// The structure type "Shell" of the deck.
#pragma once

#include <culm/structure/structure_context.hpp>

namespace culm::shell {

/// Parameters of a shell: its layup, kind of element, and the list `Mesh` (see mesh_types.hpp).
Schema shell_schema();

/// Adds nodes, elements and a structure named like the list. Node sets: the edges of the mesh,
/// their common nodes ("u0 v1"), and "all". Throws InputError.
void add_shell(const Options& options, structure::StructureContext& context);

/// Adds the type "Shell" of the deck's list "Structures".
void register_shells(structure::StructureRegistry& registry);

}  // namespace culm::shell
