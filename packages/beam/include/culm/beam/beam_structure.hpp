/// The structure type "Beam" of the deck.
#pragma once

#include <culm/structure/structure_context.hpp>

namespace culm::beam {

/// Parameters of a beam: sections, kind of element, and the list `Curve` (see axis_types.hpp).
Schema beam_schema();

/// Adds nodes, elements and a structure named like the list. Node sets: first, last, all; middle
/// when a node lies at half the length; corners, the nodes at kinks, where there are any.
/// Throws InputError.
void add_beam(const Options& options, structure::StructureContext& context);

}  // namespace culm::beam
