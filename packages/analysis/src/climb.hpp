/// From equilibrium to equilibrium.
#pragma once

#include <culm/analysis/analysis.hpp>

namespace culm::analysis {

/// Goes to a load level, up or down, in steps that are halved where the iteration fails; at least
/// one, because loads that do not depend on the level may be out of balance. Throws NumericalError.
void climb(Context& context, model::State& state, solver::NewtonSolver& newton, double level);

}  // namespace culm::analysis
