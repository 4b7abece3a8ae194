#include <culm/analysis/element_turns.hpp>
#include <culm/analysis/post_mortem.hpp>
#include <culm/base/error.hpp>
#include <culm/model/limited_hold.hpp>

#include "softest_direction.hpp"
#include "turns.hpp"
#include "weak_direction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace culm::analysis {
namespace {

using assembly::Vector;

constexpr std::size_t kept_attempts = 8;
constexpr double singular_ratio = 2e-15;  // |A v| / |A| of a direction that nothing resists
// Of the right-hand side, what flexibilities, and responses that would be huge, leave unsolved.
constexpr double rough = 1e-6;

constexpr const char* beyond_range =
    "Likely cause: a load, stiffness or length beyond the range of numbers.\n"
    "Try: check units and load functions.";

// What elements themselves have to do with it, which comes before what the structure has.
struct CoarseMesh {
  std::string words;
  bool is_the_cause = false;
};

CoarseMesh judge_mesh(const assembly::System& system, const model::State& state,
                      const char* time_word) {
  const ElementTurns turns(system);
  const double share = turns.largest_share(state.next);
  if (share <= 1.0) return {};
  const ElementTurn turn = turns.find(state.next, share);
  if (!turn.may_be_the_limit()) {
    return {fmt::format("The model is coarse here: {}:\n{}.\n", turn.name(), turn.consequence())};
  }
  return {fmt::format("Likely cause: the limit of {}. At {} {:.6g}\n{};\n"
                      "its moment grows up to {:.3g} rad only, that of the structure beyond.\n"
                      "Try: {}.",
                      turn.kind.of_frame ? "a beam of small rotations" : "a coarse mesh", time_word,
                      state.time, turn.name(), model::TurnLaw(turn.kind.order).greatest_moment(),
                      turn.cure()),
          true};
}

// Names what holds the model by friction, if anything does.
std::string friction_in(const model::Model& model) {
  for (const auto& load : model.loads()) {
    const auto* hold = dynamic_cast<const model::LimitedHold*>(load.get());
    if (hold != nullptr && hold->may_slide()) return load->effect().quoted();
  }
  return {};
}

// Whether a direction of unit maximum norm is resisted by more than rounding of the matrix.
bool resists(const assembly::System& system, const std::optional<Vector>& direction) {
  if (!direction) return false;
  double largest = 0.0;
  for (double value : system.matrix()->values()) largest = std::max(largest, std::abs(value));
  Vector force(direction->rows());
  system.matrix()->multiply(*direction, force);
  return force.largest() > singular_ratio * system.comm().max(largest) ||
         resistance(*system.matrix(), *direction) > least_resistance;
}

}  // namespace

PostMortem::PostMortem(Context& context, model::State& state, const Stencil& stencil,
                       double first_level)
    : context_(context), level_step_(first_level - state.time) {
  first_flexibility_ = load_flexibility(state, stencil, level_step_);
  singular_ = judge(state, irregular(context.system.layout().rows()));
}

PostMortem::PostMortem(Context& context, model::State& state, const Stencil& stencil)
    : context_(context) {
  singular_ = find_singular(state, stencil);
  refuse_singular();
}

PostMortem::PostMortem(Context& context, const Snapshot& snapshot)
    : context_(context),
      first_flexibility_(snapshot.number("post-mortem/first flexibility")),
      level_step_(snapshot.number("post-mortem/level step")) {}

void PostMortem::save(Snapshot& snapshot) const {
  snapshot.set("post-mortem/first flexibility", first_flexibility_);
  snapshot.set("post-mortem/level step", level_step_);
}

void PostMortem::record(const StepReport& report) {
  if (attempts_.size() == kept_attempts) attempts_.pop_front();
  attempts_.push_back(report);
  if (!report.accepted)
    worst_ = UnknownNames(context_.system).largest_entries(context_.system.residual(), 5);
}

double PostMortem::load_flexibility(model::State& state, const Stencil& stencil,
                                    double level_step) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  assembly::System& system = context_.system;
  const double level = state.time;
  state.time = level + level_step;
  system.prepare(state, stencil);
  system.evaluate(state, stencil, Want::residual);
  Vector load = system.residual();
  state.time = level;
  system.prepare(state, stencil);
  system.evaluate(state, stencil, Want::residual_and_tangent);
  load.update(1.0 / level_step, system.residual(), -1.0 / level_step);
  is_factored_ = context_.linear.factor();
  if (!is_factored_) return infinite;
  Vector response(load.rows());
  if (!context_.linear.solve_roughly(load, response, rough).is_sound()) return infinite;
  return load.dot(response);
}

bool PostMortem::is_singular(model::State& state, const Stencil& stencil) {
  return !find_singular(state, stencil).empty();
}

std::string PostMortem::find_singular(model::State& state, const Stencil& stencil) {
  context_.system.evaluate(state, stencil, Want::residual_and_tangent);
  const Vector probe = irregular(context_.system.layout().rows());
  is_factored_ = context_.linear.factor_for(probe);  // the only solution, mostly
  return judge(state, probe);
}

void PostMortem::refuse_singular() const {
  if (is_singular()) throw NumericalError(singular_);
}

std::string PostMortem::judge(const model::State& state, const Vector& probe) {
  assembly::System& system = context_.system;
  if (system.layout().rows().total() == 0) return {};  // held or rigid altogether
  Vector response(system.layout().rows());
  const double size = system.matrix()->norm();
  if (!std::isfinite(size)) {
    throw NonFiniteError(
        fmt::format("The stiffness is not finite at {} {:.6g}, before the first step.\n{}",
                    time_word(), state.time, beyond_range));
  }
  const bool solves =
      is_factored_ && context_.linear.solve_roughly(probe, response, rough).is_sound();
  if (solves && response.largest() * size < 1e13 * probe.largest()) return {};
  // most soft models show by the factors at hand that they are none; others take as much memory
  if (solves && resists(system, softest_direction(context_.linear, probe.rows()))) return {};
  Vector direction(system.layout().rows());
  const double ratio = context_.linear.weakest_direction(direction);
  if (size == 0.0) {  // no motion is resisted
    direction = probe;
    direction.scale(1.0 / probe.largest());
  }
  // without useful factors no step can be solved, whatever the ratio
  if (solves &&
      (ratio > singular_ratio || resistance(*system.matrix(), direction) > least_resistance)) {
    return {};
  }
  return system.comm().broadcast(fmt::format(
      "The equations are singular at {} {:.6g}, before the first step.\n{}", time_word(),
      state.time, WeakDirection(context_.system, state).singular_cause(direction)));
}

void PostMortem::refuse_massless(Context& context, const model::State& state) {
  Vector direction(context.system.layout().rows());
  context.linear.weakest_direction(direction);
  throw NumericalError(
      context.system.comm().broadcast(WeakDirection(context.system, state).massless(direction)));
}

std::string PostMortem::history() const {
  std::string text = "Last steps:\n";
  for (const StepReport& a : attempts_) {
    text += fmt::format("  {} {:<12.8g} increment {:<10.3g} {:>3} iterations  {}\n", time_word(),
                        a.time, a.increment, a.outcome.iterations,
                        a.outcome.converged() && !a.accepted ? "converged, but was not taken"
                                                             : solver::describe(a.outcome.end));
  }
  if (!attempts_.empty()) {
    text += "Force residual of the last attempt, relative:";
    for (const solver::IterationRecord& r : attempts_.back().outcome.history) {
      text += fmt::format(" {:.1e}", r.force);
    }
    text += '\n';
  }
  return text;
}

std::string PostMortem::worst_rows() const {
  std::string text = "Largest residuals of the last attempt:\n";
  for (const UnknownNames::Entry& entry : worst_) {
    text += fmt::format("  {:<40} {:+.3e}\n", entry.name, entry.value);
  }
  return text;
}

const model::Constraint* PostMortem::turn_too_far(model::State& state,
                                                  const Stencil& stencil) const {
  const double accepted = state.time;
  state.time = attempts_.back().time;
  const model::Constraint* turn = find_too_far(context_.system, state, stencil);
  state.time = accepted;
  return turn;
}

std::string PostMortem::turn_cause(const model::Constraint* turn) const {
  return fmt::format(
      "Likely cause: {} leads further at once than a step may turn, or too fast\n"
      "to be followed: the equations hold half a turn away as well.\n"
      "Try: an angle that grows with the {}, more steps.",
      turn == nullptr ? "a prescribed rotation"
                      : fmt::format("the rotation that {} '{}' prescribes", turn->type, turn->name),
      time_word());
}

std::string PostMortem::cause(model::State& state, const Stencil& stencil) {
  const model::Constraint* turn = turn_too_far(state, stencil);
  if (level_step_ == 0.0) return turn != nullptr ? turn_cause(turn) : dynamic_cause();
  if (attempts_.back().outcome.end == solver::StepEnd::turned_too_far) return turn_cause(turn);
  if (!std::isfinite(attempts_.back().final_time)) return path_cause(state, stencil);
  const double now = load_flexibility(state, stencil, level_step_);
  const double remaining = std::isfinite(now) && now != 0.0 ? first_flexibility_ / now : 0.0;
  Vector direction(context_.system.layout().rows());
  const double ratio = context_.linear.weakest_direction(direction);
  const WeakDirection weak(context_.system, state);
  if (std::isfinite(first_flexibility_) && first_flexibility_ > 0.0 && remaining < 0.15) {
    const std::string stiffness = fmt::format(
        "At level {:.6g} the structure keeps {:.1f} % of its initial\n"
        "stiffness against this load",
        state.time, 100.0 * remaining);
    const std::string local = weak.local_cause(direction);
    if (!local.empty()) {
      return fmt::format(
          "Likely cause: {}. {}.\n"
          "Try: more elements there, a load that is spread over several of them, or an analysis "
          "of\n"
          "type 'Path'.",
          local, stiffness);
    }
    return fmt::format(
        "Likely cause: a limit point. {}; the load cannot grow further on this path.\n"
        "Try: an analysis of type 'Path', which goes on beyond, or end below this level.",
        stiffness);
  }
  if (ratio < singular_ratio || attempts_.back().outcome.end == solver::StepEnd::singular) {
    return weak.singular_cause(direction);
  }
  if (attempts_.back().outcome.end == solver::StepEnd::out_of_range) {
    return "Likely cause: an element turns too far, or inside out.\n"
           "Try: smaller steps, 'Line Search' = Backtrack, more elements.";
  }
  if (const std::string friction = friction_in(context_.system.model()); !friction.empty()) {
    return fmt::format(
        "Likely cause: the friction of {} is at its limit, and nothing else holds what slides; "
        "or\n"
        "a bifurcation or a sudden change of the load is near. The structure keeps {:.1f} % of its "
        "stiffness.\n"
        "Try: a support or a spring along the way, a load that stays below what friction holds, a "
        "displacement\n"
        "that is prescribed, or 'Dynamic', in which it slides; else more steps.",
        friction, 100.0 * remaining);
  }
  return fmt::format(
      "Likely cause: the iteration does not find the next equilibrium although the structure "
      "keeps\n"
      "{:.1f} % of its stiffness; a bifurcation or a sudden change of the load may be near.\n"
      "Try: more steps, more elements, 'Line Search' = Backtrack, or a small imperfection.",
      100.0 * remaining);
}

std::string PostMortem::path_cause(model::State& state, const Stencil& stencil) {
  if (attempts_.back().outcome.end == solver::StepEnd::out_of_range) {
    return "Likely cause: an element turns too far, or inside out.\nTry: more elements.";
  }
  std::string text =
      "Likely cause: the path bends more sharply than the shortest step can follow, crosses\n"
      "another path, or ends where loads or prescribed motions do.\n";
  const double flexibility = load_flexibility(state, stencil, level_step_);
  if (is_factored_ && std::isfinite(flexibility)) {
    Vector direction(context_.system.layout().rows());
    context_.linear.weakest_direction(direction);
    text += "Here the structure is weakest against this motion, in which it may buckle:\n" +
            WeakDirection(context_.system, state).largest_motions(direction);
  }
  return text +
         "Try: a smaller 'Smallest Length' or 'First Increment', another 'Control', a mesh that\n"
         "resolves this motion, or a small imperfection.";
}

std::string PostMortem::dynamic_cause() const {
  if (attempts_.back().outcome.end == solver::StepEnd::out_of_range) {
    return "Likely cause: an element turns too far in a step, or inside out.\n"
           "Try: a smaller step, more elements.";
  }
  if (attempts_.back().outcome.end == solver::StepEnd::turned_too_far) {
    return "Likely cause: a body spins too fast for the steps.\nTry: a smaller step.";
  }
  return "Likely cause: a sudden change of load, or motion that the mesh cannot follow.\n"
         "Try: a smaller step, 'Line Search' = Backtrack, more elements, or some dissipation.";
}

void PostMortem::give_up(model::State& state, const Stencil& stencil, std::optional<double> end) {
  const StepReport& last = attempts_.back();
  const bool end_is_known = std::isfinite(last.final_time);
  std::string text =
      fmt::format("No equilibrium beyond {} {:.8g}{}: {}.\n", time_word(), state.time,
                  end_is_known ? fmt::format(" of {:.8g}", last.final_time) : std::string(),
                  solver::describe(last.outcome.end));
  if (end) {
    text += fmt::format(
        "Steps fail sooner and sooner: what they gain sums up to level {:.8g}, so none is tried.\n",
        *end);
  }
  text += history() + worst_rows();
  const bool not_finite = last.outcome.end == solver::StepEnd::not_finite;
  if (not_finite) {
    text += beyond_range;
  } else {
    const CoarseMesh mesh = judge_mesh(context_.system, state, time_word());
    text += mesh.words;
    if (!mesh.is_the_cause) text += cause(state, stencil);
  }
  text = context_.system.comm().broadcast(text);
  if (not_finite) throw NonFiniteError(text);
  throw NumericalError(text);
}

}  // namespace culm::analysis
