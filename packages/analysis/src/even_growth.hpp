/// Loads and levels.
#pragma once

#include <culm/analysis/analysis.hpp>

namespace culm::analysis {

/// Whether loads grow evenly from the level of a state to another one, so that a share of their
/// change is the load at the same share of the way. Those of a rotating frame do not, which grow
/// with the square of the speed, nor those of functions that are no straight line. Collective;
/// needs System::prepare anew.
bool grow_evenly(Context& context, model::State at, double level);

}  // namespace culm::analysis
