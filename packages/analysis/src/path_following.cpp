#include <culm/analysis/path_following.hpp>
#include <culm/base/error.hpp>

#include "mirrored_faces.hpp"
#include "path_end.hpp"
#include "shear_range.hpp"
#include "softest_direction.hpp"
#include "take_up.hpp"
#include "turns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace culm::analysis {
namespace {

using assembly::Vector;
using solver::StepEnd;

// Of what the tangent promises for a change of the watched displacement.
constexpr double longest_way = 3.0;
// For derivatives by the level, over the first change of the level: exact where loads are linear.
constexpr double level_difference = 1e-3;

bool lies_between(double value, double from, double to) {
  return value != from && (from - value) * (to - value) <= 0.0;
}

std::vector<double> numbers_of(const PathPoint& p) {
  return {p.level,
          p.watched,
          p.tangent.level,
          p.tangent.watched,
          static_cast<double>(p.determinant.sign),
          p.determinant.log_size,
          p.sets_energy_free ? 1.0 : 0.0};
}

PathPoint point_of(std::span<const double> n) {
  return {n[0], n[1], {n[2], n[3]}, {static_cast<int>(n[4]), n[5]}, n[6] != 0.0};
}

std::optional<WatchedMotion> find_watched(const PathSettings& settings, const model::Model& model) {
  if (!settings.watch) return {};
  const WatchSettings& watch = *settings.watch;
  const std::vector<int> nodes = model.select_nodes(watch.node);
  if (nodes.size() != 1) {
    throw InputError(watch.node_where, fmt::format("'{}' names {} nodes, but one is watched",
                                                   watch.node, nodes.size()));
  }
  return WatchedMotion{nodes.front(), watch.direction};
}

double compute_level_difference(const PathSettings& settings) {
  const bool is_level = settings.control != PathControl::displacement;
  return level_difference * (is_level ? settings.first_increment : 1.0);
}

}  // namespace

PathFollowing::PathFollowing(PathSettings settings, Context& context, model::State& state)
    : Stepper(context, state),
      settings_(std::move(settings)),
      condition_(context.system, settings_.control, find_watched(settings_, context.system.model()),
                 compute_level_difference(settings_)) {
  condition_.set_probe([this] {
    if (!known_.is_examined) look_for_free_energy();
  });
}

std::unique_ptr<Stepper> PathFollowing::make(const Options& options, Context& context,
                                             model::State& state) {
  return std::make_unique<PathFollowing>(read_path_settings(options), context, state);
}

void PathFollowing::do_begin() {
  const Stencil stencil = Stencil::statics();
  model::State& state = this->state();
  make_newton(settings_.newton);
  state.time = state.time_prev = settings_.start_level;
  state.velocity.release(0, state.velocity.size());  // as in statics
  system().prepare(state, stencil);
  system().choose_multiplier_scale(state, stencil);
  make_post_mortem(state, stencil, state.time + 1e3 * condition_.level_difference());
  post_mortem().refuse_singular();
  balance_start();
  condition_.begin(settings_.first_increment);
  const auto [tangent, determinant] = compute_tangent();
  known_.here = {state.time, condition_.watched_displacement(state.next), tangent, determinant};
  pace_.add(known_.here.level, known_.here.watched);
  known_.is_examined = true;
  if (determinant.sign == 0) {
    context().findings.warn(
        "no determinants",
        "bifurcations of the path are not looked for, because the linear solver '" +
            context().linear.name() + "' knows no determinant; take 'Linear Solver' = MUMPS",
        state.time);
  }
  size_ = settings_.first_increment;
  if (settings_.control != PathControl::displacement) size_ = std::abs(size_ / tangent.level);
  first_size_ = size_;
}

// Loads that do not grow with the level act at its start already.
void PathFollowing::balance_start() {
  model::State& state = this->state();
  StepReport report;
  report.time = state.time;
  report.final_time = final_time();
  report.outcome = newton().solve(state, Stencil::statics());
  refuse_mirrored(context(), state, report.outcome);
  refuse_missed_turns(context(), state, Stencil::statics(), report.outcome);
  report.accepted = report.outcome.converged();
  post_mortem().record(report);
  if (report.accepted) {
    system().accept(state);
    return;
  }
  system().discard(state);
  if (take_up(context(), newton(), state) == TakeUp::done) return;
  post_mortem().give_up(state, Stencil::statics());
}

// Where one direction has lost its stiffness, it hides others.
void PathFollowing::look_for_free_energy() {
  known_.here.sets_energy_free =
      known_.events.empty() && sets_energy_free(system(), context().linear);
}

std::pair<PathTangent, solver::Determinant> PathFollowing::compute_tangent() {
  const Stencil stencil = Stencil::statics();
  model::State& state = this->state();
  solver::LinearSolver& linear = context().linear;
  system().prepare(state, stencil);
  system().evaluate(state, stencil, Want::residual_and_tangent);
  Vector gradient(system().layout().rows());
  Vector flexibility(system().layout().rows());
  system().level_gradient(state, stencil, condition_.level_difference(), gradient);
  if (!linear.factor()) return {};
  linear.solve(gradient, flexibility);
  flexibility.scale(-1.0);
  condition_.compute_tangent(state, flexibility);
  refuse_idle_level();
  return {*condition_.tangent(), linear.determinant()};
}

void PathFollowing::refuse_idle_level() const {
  if (!condition_.tangent()) return;
  const PathTangent& tangent = *condition_.tangent();
  const bool is_watched = settings_.control == PathControl::displacement;
  if (steps() == 0 && is_watched && std::isfinite(tangent.level) && tangent.watched == 0.0) {
    throw NumericalError(fmt::format(
        "There is no path to follow by displacement control: at level {:.6g} the watched "
        "displacement of '{}' does not change with the level.\n"
        "Try: another node or direction to watch, or another 'Control'.",
        state().time_prev, settings_.watch->node));
  }
  if (std::isfinite(tangent.level)) return;
  throw NumericalError(fmt::format(
      "There is no path to follow at level {:.6g}: nothing that moves the structure changes with "
      "the level there.\n"
      "Try: a load or prescribed motion with a function that grows with the level, such as "
      "'Ramp'.",
      state().time_prev));
}

bool PathFollowing::reaches_end() const {
  if (known_.is_ended || steps() >= settings_.steps) return true;
  return steps() > 0 && is_on_target();
}

bool PathFollowing::is_on_target() const {
  if (settings_.final_level && state().time_prev == *settings_.final_level) return true;
  return settings_.final_displacement &&
         std::abs(known_.here.watched - *settings_.final_displacement) <=
             1e-9 * system().model().length();
}

bool PathFollowing::passed_limit_points() const {
  const auto count = std::count_if(
      known_.events.begin(), known_.events.end(),
      [](const PathEvent& event) { return event.kind == PathEventKind::limit_point; });
  return settings_.limit_points && count >= *settings_.limit_points;
}

void PathFollowing::report_early_end() const {
  if (steps() < settings_.steps || is_on_target() || passed_limit_points()) return;
  const std::string targets = name_targets(settings_);
  if (targets.empty()) return;
  context().findings.broken(
      "path",
      fmt::format("the path ended at level {:.6g} after {} steps, all that 'Steps' allows, before "
                  "it reached {}{}",
                  state().time, steps(), targets,
                  explain_missing_steps(settings_, pace_, std::abs(size_ / first_size_),
                                        known_.events.size())),
      state().time);
}

void PathFollowing::land(solver::StepOutcome& outcome) {
  model::State& state = this->state();
  const Stencil stencil = Stencil::statics();
  const auto solve_on = [&](solver::LevelCondition* condition) {
    system().prepare(state, stencil);
    const solver::StepOutcome landing = newton().solve(state, stencil, condition);
    outcome.end = landing.end;
    outcome.iterations += landing.iterations;
    outcome.history.insert(outcome.history.end(), landing.history.begin(), landing.history.end());
    outcome.last = landing.last;
    outcome.held_unknown = landing.held_unknown;
  };
  if (settings_.final_level && lies_between(*settings_.final_level, state.time_prev, state.time)) {
    state.time = *settings_.final_level;
    solve_on(nullptr);
  }
  if (!settings_.final_displacement || !outcome.converged()) return;
  const double end = *settings_.final_displacement;
  if (lies_between(end, known_.here.watched, condition_.watched_displacement(state.next))) {
    condition_.begin_to_displacement(end - known_.here.watched);
    solve_on(&condition_);
  }
}

StepReport PathFollowing::do_attempt(double size) {
  before_ = known_;
  attempted_ = size;
  is_on_branch_ = false;
  StepReport report;
  report.outcome = go_on(size);
  if (!known_.is_examined && condition_.tangent()) {
    if (examine(*condition_.tangent(), report.outcome.first_determinant)) {
      system().discard(state());
      locate_events();
      std::optional<solver::StepOutcome> found;
      if (is_to_branch()) found = branch_off();
      is_on_branch_ = found.has_value();
      report.outcome = is_on_branch_ ? std::move(*found) : go_on(size);
    }
  }
  report.time = state().time;
  report.increment = state().time - state().time_prev;
  return report;
}

std::optional<Vector> PathFollowing::find_flexibility() {
  const Stencil stencil = Stencil::statics();
  system().evaluate(state(), stencil, Want::residual_and_tangent);
  Vector gradient(system().layout().rows()), flexibility(system().layout().rows());
  system().level_gradient(state(), stencil, condition_.level_difference(), gradient);
  if (!context().linear.factor()) return {};
  if (!context().linear.solve(gradient, flexibility).is_sound()) return {};
  flexibility.scale(-1.0);
  return flexibility;
}

bool PathFollowing::leaps() {
  if (settings_.control != PathControl::displacement || !condition_.tangent()) return false;
  const double moved = condition_.watched_displacement(state().next) - known_.here.watched;
  const double rise = state().time - state().time_prev;
  const PathTangent& start = *condition_.tangent();
  if (condition_.length(state()) * std::abs(start.watched) > longest_way * std::abs(moved)) {
    return true;
  }
  if (rise * moved * start.level * start.watched >= 0.0) return false;
  const std::optional<Vector> flexibility = find_flexibility();
  return flexibility && rise * moved * condition_.watched_by_level(state(), *flexibility) < 0.0;
}

solver::StepOutcome PathFollowing::go_on(double size) {
  const Stencil stencil = Stencil::statics();
  condition_.begin(size);
  system().prepare(state(), stencil);
  solver::StepOutcome outcome = newton().solve(state(), stencil, &condition_);
  refuse_idle_level();
  const auto keep_to_path = [&] {
    if (outcome.converged() && (condition_.straightness(state()) < least_straightness || leaps())) {
      outcome.end = StepEnd::off_path;
    }
  };
  keep_to_path();
  if (!outcome.converged()) return outcome;
  land(outcome);
  keep_to_path();
  refuse_mirrored(context(), state(), outcome);
  refuse_missed_turns(context(), state(), stencil, outcome);
  return outcome;
}

// Where a function of loads or motions ends, the path does.
void PathFollowing::explain_failure() {
  const Stencil stencil = Stencil::statics();
  model::State& state = this->state();
  Vector above(system().layout().rows());
  Vector below(above.rows());
  const double step = 10.0 * condition_.level_difference();
  system().prepare(state, stencil);
  system().level_gradient(state, stencil, step, above);
  system().level_gradient(state, stencil, -step, below);
  const double size = std::max(above.largest(), below.largest());
  above.update(-1.0, below, 1.0);
  if (above.largest() < 0.5 * size) return;
  throw NumericalError(
      fmt::format("The path ends at level {:.6g}: the growth of loads or prescribed motions with "
                  "the level changes abruptly there.\n"
                  "Try: functions without corners, such as 'Ramp'.",
                  state.time));
}

void PathFollowing::do_accept(const StepReport& report) {
  model::State& state = this->state();
  tell_events();
  failures_ = 0;
  last_length_ = condition_.length(state);
  condition_.accept(state);
  known_.behind = known_.here;
  known_.here = {state.time, condition_.watched_displacement(state.next), {}, {}};
  pace_.add(known_.here.level, known_.here.watched);
  // what lies before a branch is the bifurcation that is known
  known_.has_behind = known_.is_examined && !is_on_branch_;
  known_.is_examined = false;
  system().accept(state);
  if (is_on_branch_) {
    context().log.info(fmt::format("on the crossing path from level {:.6g}", state.time));
  }
  const double factor = std::sqrt(static_cast<double>(settings_.desired_iterations) /
                                  std::max(1, report.outcome.iterations));
  const double size = std::abs(attempted_) * std::clamp(factor, 0.25, 2.0);
  const double first = std::abs(first_size_);
  size_ = std::copysign(
      std::clamp(size, settings_.smallest_length * first, settings_.largest_length * first),
      attempted_);
}

bool PathFollowing::do_fail(const StepReport&) {
  tell_events();
  size_ = attempted_ * (++failures_ == 1 ? 0.5 : 0.25);
  return std::abs(size_) < settings_.smallest_length * std::abs(first_size_);
}

AnalysisReport PathFollowing::do_finish() {
  // reactions, too, are those of this state afterwards
  const auto [tangent, determinant] = compute_tangent();
  if (!known_.is_examined) {
    before_ = known_;
    look_for_free_energy();
    if (examine(tangent, determinant)) {
      locate_events();
      if (is_to_branch()) {
        context().findings.warn(
            "branch",
            "the path ends on the step in which another one crosses it, before that could "
            "be followed; try shorter steps, or an end farther on",
            known_.events.back().level);
      }
      compute_tangent();
    }
  }
  tell_events();
  if (!known_.is_ended) report_early_end();
  warn_of_shear(context(), state());
  return report();
}

AnalysisReport PathFollowing::report() const {
  AnalysisReport report;
  report.text = fmt::format("path of {} steps to level {:.6g}\n", steps(), known_.here.level);
  std::map<std::string, int> counts;
  for (const PathEvent& event : known_.events) {
    report.text += "  " + describe(event) + "\n";
    const std::string kind = name_of(event.kind);
    const std::string name = fmt::format("{} {}", kind, ++counts[kind]);
    report.numbers.emplace_back(name + ", level", event.level);
    if (settings_.watch) report.numbers.emplace_back(name + ", displacement", event.watched);
  }
  return report;
}

void PathFollowing::do_save(Snapshot& snapshot) const {
  snapshot.set("path/step", {size_, first_size_, last_length_, static_cast<double>(failures_),
                             known_.is_examined ? 1.0 : 0.0, known_.has_behind ? 1.0 : 0.0,
                             known_.has_branched ? 1.0 : 0.0, known_.is_ended ? 1.0 : 0.0});
  snapshot.set("path/behind", numbers_of(known_.behind));
  snapshot.set("path/here", numbers_of(known_.here));
  std::vector<double> events;
  for (const PathEvent& event : known_.events) {
    events.insert(events.end(), {static_cast<double>(event.kind), event.level, event.watched});
  }
  snapshot.set("path/events", std::move(events));
  condition_.save(snapshot);
  pace_.save(snapshot);
}

void PathFollowing::do_restore(const Snapshot& snapshot) {
  const std::span<const double> step = snapshot.numbers("path/step", 8);
  size_ = step[0];
  first_size_ = step[1];
  last_length_ = step[2];
  failures_ = static_cast<int>(step[3]);
  known_ = {};
  known_.is_examined = step[4] != 0.0;
  known_.has_behind = step[5] != 0.0;
  known_.has_branched = step[6] != 0.0;
  known_.is_ended = step[7] != 0.0;
  known_.behind = point_of(snapshot.numbers("path/behind", 7));
  known_.here = point_of(snapshot.numbers("path/here", 7));
  const std::span<const double> events = snapshot.numbers("path/events");
  for (std::size_t i = 0; i + 2 < events.size(); i += 3) {
    known_.events.push_back(
        {static_cast<PathEventKind>(static_cast<int>(events[i])), events[i + 1], events[i + 2]});
  }
  before_ = known_;
  condition_.restore(snapshot);
  pace_.restore(snapshot);
}

}  // namespace culm::analysis
