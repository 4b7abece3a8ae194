#include "climb.hpp"

#include <culm/base/error.hpp>

#include "turns.hpp"

#include <fmt/format.h>

#include <cmath>

namespace culm::analysis {

void climb(Context& context, model::State& state, solver::NewtonSolver& newton, double level) {
  const Stencil stencil = Stencil::statics();
  const double way = level - state.time_prev;
  state.velocity.release(0, state.velocity.size());  // as in statics
  double increment = way;
  do {
    const bool is_last = std::abs(level - state.time_prev) <= std::abs(increment) * (1.0 + 1e-9);
    state.time = is_last ? level : state.time_prev + increment;
    context.system.prepare(state, stencil);
    solver::StepOutcome outcome = newton.solve(state, stencil);
    refuse_missed_turns(context, state, stencil, outcome);
    if (outcome.converged()) {
      context.system.accept(state);
      continue;
    }
    const double failed = state.time;
    context.system.discard(state);
    increment *= 0.5;
    if (std::abs(increment) <= 1e-4 * std::abs(way)) {
      throw NumericalError(fmt::format(
          "No equilibrium between level {:.6g} and {:.6g}: {}.\nTry: a static analysis up to "
          "there, which says more.",
          state.time_prev, failed, solver::describe(outcome.end)));
    }
  } while (state.time_prev != level);
}

}  // namespace culm::analysis
