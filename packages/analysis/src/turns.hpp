/// Turns that are prescribed or counted.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/solver/newton_solver.hpp>

#include <numbers>

namespace culm::analysis {

/// How far a prescribed turn may lead in a step of statics [rad]. Beyond, Newton's method goes to
/// where the equations hold as well, half a turn back.
constexpr double quarter_turn = 0.5 * std::numbers::pi;

/// The first prescribed turn that leads too far in a step from state.prev to state.time, or null.
/// What the state has not reached at the start of the step counts as well. Collective.
const model::Constraint* find_too_far(const assembly::System& system, const model::State& state,
                                      const Stencil& stencil);

/// Refuses a converged step in which a prescribed turn leads too far, or which met its equations
/// half a turn away: no state counts turns, and elements that were not taken along would be left as
/// they are. Collective.
void refuse_missed_turns(Context& context, const model::State& state, const Stencil& stencil,
                         solver::StepOutcome& outcome);

/// Refuses a converged step of a motion that turns two joined nodes against each other by more than
/// one may turn, because springs and histories count the angle of a joint by its change.
/// Collective.
/// @param largest_turn  of a node in the step [rad]: two that turn by half of what one may are not
///                      looked at
void refuse_turns_apart(Context& context, const model::State& state, double largest_turn,
                        solver::StepOutcome& outcome);

}  // namespace culm::analysis
