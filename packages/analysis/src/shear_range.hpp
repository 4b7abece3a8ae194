/// Walls that are too thick for what a result shows of them.
#pragma once

#include <culm/analysis/find_modes.hpp>

namespace culm::analysis {

/// Warns if transverse shear takes so much of the energy of shells in a state that the shear
/// correction which their walls go without changes displacements notably. What is stored in shear
/// is U_s of all U, and the correction adds the share c to that flexibility: displacements grow by
/// c U_s / U to first order. Short waves in thick walls have a large U_s. Brings the state up to
/// date on all ranks. Collective.
void warn_of_shear(Context& context, model::State& state);

/// The same of the first mode for which that holds; frequencies fall by half as much. The state is
/// up to date on all ranks.
void warn_of_shear(Context& context, const model::State& state, const ModeSet& set);

}  // namespace culm::analysis
