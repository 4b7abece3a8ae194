/// Strips that load the same piece of a structure.
#pragma once

#include <culm/model/model.hpp>
#include <culm/strip/strip_load.hpp>

namespace culm::strip {

/// Whether two loads have a chord in common: on the same line, on the same node, or on a line and a
/// node of it, two chords of which one lies over the other. Chords that cross, as those of a wing
/// and a fin, or lie behind each other, as those of a wing and a tail, have nothing in common. The
/// whole span counts; on lines each station is compared with the one beside it.
bool share_chord(const StripLoad& a, const StripLoad& b, const model::Model& model);

/// Whether two loads that share a chord count the air twice in a step: together they take more of
/// it than the whole, and than the larger of them does alone. Loads that take turns do not, nor do
/// those of which one fades in as the other fades out.
bool count_twice(const StripLoad& a, const StripLoad& b, const model::State& state,
                 const Stencil& stencil);

}  // namespace culm::strip
