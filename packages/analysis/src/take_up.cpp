#include "take_up.hpp"

#include "mirrored_faces.hpp"
#include "turns.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace culm::analysis {
namespace {

constexpr double balanced = 1e-6;  // of the largest force
constexpr double first_share = 0.25;
constexpr double least_share = 1e-4;
constexpr int few_iterations = 6;

// To where so much of what was noted still stays out.
solver::StepOutcome step_to(double held, Context& context, solver::NewtonSolver& newton,
                            model::State& state) {
  const Stencil stencil = Stencil::statics();
  context.system.hold_back(held);
  context.system.prepare(state, stencil);
  solver::StepOutcome outcome = newton.solve(state, stencil);
  refuse_mirrored(context, state, outcome);
  refuse_missed_turns(context, state, stencil, outcome);
  outcome.converged() ? context.system.accept(state) : context.system.discard(state);
  return outcome;
}

struct Progress {
  double held = 1.0;  // what stays out
  int steps = 0;
};

Progress make_steps(Context& context, solver::NewtonSolver& newton, model::State& state) {
  Progress progress;
  double share = first_share;
  while (progress.held > 0.0 && share >= least_share) {
    const double next = std::max(0.0, progress.held - share);
    const solver::StepOutcome outcome = step_to(next, context, newton, state);
    if (!outcome.converged()) {
      share = 0.5 * (progress.held - next);
      continue;
    }
    ++progress.steps;
    progress.held = next;
    if (outcome.iterations <= few_iterations) share *= 1.5;
  }
  return progress;
}

void tell(const Progress& progress, double level, const Log& log) {
  const std::string what = fmt::format(
      "what acts in full at level {:g}, such as loads that follow 'Constant', was taken up there "
      "in {} steps",
      level, progress.steps);
  if (progress.held == 0.0) {
    log.info("note: " + what + ": with all of it at once no equilibrium was found");
  } else {
    log.info(fmt::format("note: {:.3g} % of {}, and there is no equilibrium beyond",
                         100.0 * (1.0 - progress.held), what));
  }
}

}  // namespace

TakeUp take_up(Context& context, solver::NewtonSolver& newton, model::State& state) {
  assembly::System& system = context.system;
  const assembly::Evaluation found = system.note_unbalance(state, Stencil::statics());
  Progress progress;
  if (found.force_scale > 0.0 && found.force_residual > balanced * found.force_scale) {
    progress = make_steps(context, newton, state);
  }
  system.carry_residuals(false);
  if (progress.steps == 0) return TakeUp::nothing;
  tell(progress, state.time, context.log);
  return progress.held == 0.0 ? TakeUp::done : TakeUp::stuck;
}

}  // namespace culm::analysis
