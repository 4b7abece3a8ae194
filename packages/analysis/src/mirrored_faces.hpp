/// Shell elements turned inside out.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/solver/newton_solver.hpp>

namespace culm::analysis {

/// Refuses a converged step, as one that left the domain of an element, if a face of a shell is its
/// own mirror image: it turned around one of its lines while its directors stayed. An iteration
/// that goes astray may find such a state; strains, quadratic in the coordinates, do not see it.
/// Brings the state up to date on all ranks where there are shells. Collective.
void refuse_mirrored(Context& context, model::State& state, solver::StepOutcome& outcome);

}  // namespace culm::analysis
