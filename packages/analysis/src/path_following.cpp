#include <culm/analysis/newton_options.hpp>
#include <culm/analysis/path_following.hpp>
#include <culm/base/error.hpp>
#include <culm/base/text.hpp>

#include "mirrored_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace culm::analysis {
namespace {

using assembly::Vector;
using solver::StepEnd;

// A step that bends more than this may have reached another piece of the path.
constexpr double least_straightness = 0.5;
// For derivatives by the level, over the first change of the level: exact where loads are linear.
constexpr double level_difference = 1e-3;

const std::vector<std::pair<std::string, PathControl>>& controls() {
  static const std::vector<std::pair<std::string, PathControl>> names = {
      {"Linearised Sphere", PathControl::linearised_sphere},
      {"Normal Plane", PathControl::normal_plane},
      {"Sphere", PathControl::sphere},
      {"Displacement", PathControl::displacement}};
  return names;
}

const std::vector<std::pair<std::string, AtBifurcation>>& bifurcation_choices() {
  static const std::vector<std::pair<std::string, AtBifurcation>> names = {
      {"Report", AtBifurcation::report},
      {"Stop", AtBifurcation::stop},
      {"Follow", AtBifurcation::follow}};
  return names;
}

template <class Value>
std::vector<std::string> names_of(const std::vector<std::pair<std::string, Value>>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) names.push_back(name);
  return names;
}

template <class Value>
Value value_of(const std::string& chosen,
               const std::vector<std::pair<std::string, Value>>& choices) {
  return std::find_if(choices.begin(), choices.end(),
                      [&](const auto& choice) { return choice.first == chosen; })
      ->second;
}

Schema watch_schema() {
  return Schema("Watch", "The displacement that a path is seen by.")
      .add(text("Node", "The node, such as 'structure/last'."))
      .add(numbers("Direction", "", "Direction of the displacement; its length does not matter.")
               .size(3))
      .add(number("Final Displacement", "m", "Displacement at which the path ends.").optional());
}

void check_path(const Options& options, InputIssues& issues) {
  if (options.number("First Increment") == 0.0) {
    issues.add(options.where("First Increment"), "must not be 0");
  }
  if (!options.has_list("Watch")) {
    if (options.text("Control") == "Displacement") {
      issues.add(options.where("Control"),
                 "displacement control needs a list 'Watch' with the node and the direction");
    }
    return;
  }
  const Options& watch = options.list("Watch");
  const std::vector<double>& direction = watch.numbers("Direction");
  if (std::all_of(direction.begin(), direction.end(), [](double d) { return d == 0.0; })) {
    issues.add(watch.where("Direction"), "must not be zero");
  }
}

bool lies_between(double value, double from, double to) {
  return value != from && (from - value) * (to - value) <= 0.0;
}

std::vector<double> numbers_of(const PathPoint& p) {
  return {p.level,
          p.watched,
          p.tangent.level,
          p.tangent.watched,
          static_cast<double>(p.determinant.sign),
          p.determinant.log_size};
}

PathPoint point_of(const std::vector<double>& n) {
  return {n[0], n[1], {n[2], n[3]}, {static_cast<int>(n[4]), n[5]}};
}

}  // namespace

Schema PathFollowing::schema() {
  const PathSettings defaults;
  return Schema("Path",
                "Equilibrium path through limit points, by arc length or displacement control.")
      .add(choice("Control", names_of(controls()),
                  "The condition that a step fulfils: of three on the length of its way, or a "
                  "displacement of the watched node. All trace the same path.")
               .optional("Linearised Sphere"))
      .add(number("First Increment", "",
                  "Change of the level in the first step, negative to begin with a falling level; "
                  "with Control = Displacement the displacement of the watched node [m].")
               .optional(defaults.first_increment))
      .add(number("Start Level", "1", "Level at which the path begins.")
               .optional(defaults.start_level))
      .add(number("Final Level", "1", "Level at which the path ends when it first gets there.")
               .optional())
      .add(integer("Limit Points", "Number of limit points after which the path ends.")
               .at_least(1)
               .optional())
      .add(integer("Steps", "Number of steps after which the path ends.")
               .at_least(1)
               .optional(defaults.steps))
      .add(integer("Desired Iterations",
                   "Steps with more iterations make the next one shorter, others longer.")
               .at_least(1)
               .optional(defaults.desired_iterations))
      .add(number("Smallest Length", "1", "Bound on steps, over the length of the first one.")
               .positive()
               .optional(defaults.smallest_length))
      .add(number("Largest Length", "1", "Bound on steps, over the length of the first one.")
               .positive()
               .optional(defaults.largest_length))
      .add(choice("Bifurcation", names_of(bifurcation_choices()),
                  "What to do where another path crosses: report it, end, or go on on the first "
                  "one that does.")
               .optional("Report"))
      .add(
          number(
              "Branch Amplitude", "m",
              "First distance from the old path when another is followed, a root mean square "
              "over all nodes; a negative one makes the watched displacement fall. The length of a "
              "step if absent.")
              .optional())
      .list("Watch", watch_schema(), Presence::optional)
      .list("Newton", newton_schema(), Presence::defaulted)
      .check(check_path);
}

std::unique_ptr<Analysis> PathFollowing::make(const Options& options) {
  PathSettings settings;
  settings.control = value_of(options.text("Control"), controls());
  settings.start_level = options.number("Start Level");
  settings.first_increment = options.number("First Increment");
  settings.desired_iterations = options.integer("Desired Iterations");
  settings.smallest_length = options.number("Smallest Length");
  settings.largest_length = options.number("Largest Length");
  settings.steps = options.integer("Steps");
  if (options.has("Final Level")) settings.final_level = options.number("Final Level");
  if (options.has("Limit Points")) settings.limit_points = options.integer("Limit Points");
  settings.at_bifurcation = value_of(options.text("Bifurcation"), bifurcation_choices());
  if (options.has("Branch Amplitude")) {
    settings.branch_amplitude = options.number("Branch Amplitude");
  }
  if (options.has_list("Watch")) {
    const Options& watch = options.list("Watch");
    const std::vector<double>& direction = watch.numbers("Direction");
    settings.watch = WatchSettings{watch.where("Node"), watch.text("Node"),
                                   Vec3(direction[0], direction[1], direction[2]).normalized()};
    if (watch.has("Final Displacement")) {
      settings.final_displacement = watch.number("Final Displacement");
    }
  }
  settings.newton = newton_settings(options.list("Newton"));
  return std::make_unique<PathFollowing>(std::move(settings));
}

void PathFollowing::make_tools(Context& context) {
  std::optional<WatchedMotion> watched;
  if (settings_.watch) {
    const WatchSettings& watch = *settings_.watch;
    const std::vector<int> nodes = context.system.model().select_nodes(watch.node);
    if (nodes.size() != 1) {
      throw InputError(watch.node_where, fmt::format("'{}' names {} nodes, but one is watched",
                                                     watch.node, nodes.size()));
    }
    watched = WatchedMotion{nodes.front(), watch.direction};
  }
  const bool is_level = settings_.control != PathControl::displacement;
  condition_.emplace(context.system, settings_.control, watched,
                     level_difference * (is_level ? settings_.first_increment : 1.0));
  newton_.emplace(context.system, context.linear, settings_.newton, context.ledger);
}

void PathFollowing::start(Context& context, model::State& state) {
  const Stencil stencil = Stencil::statics();
  make_tools(context);
  state.time = state.time_prev = settings_.start_level;
  context.system.begin_step(state, stencil);
  context.system.choose_multiplier_scale(state, stencil);
  post_mortem_.emplace(context, state, stencil, state.time + 1e3 * condition_->level_difference());
  balance_start(context, state);
  condition_->begin(settings_.first_increment);
  const auto [tangent, determinant] = find_tangent(context, state);
  here_ = {state.time, condition_->watched_displacement(state.next), tangent, determinant};
  is_examined_ = true;
  size_ = settings_.first_increment;
  if (settings_.control != PathControl::displacement) size_ = std::abs(size_ / tangent.level);
  first_size_ = size_;
}

// Loads that do not grow with the level act at its start already.
void PathFollowing::balance_start(Context& context, model::State& state) {
  StepReport report;
  report.time = report.final_time = state.time;
  report.outcome = newton_->solve(state, Stencil::statics());
  refuse_mirrored(context, state, report.outcome);
  report.accepted = report.outcome.converged();
  post_mortem_->record(report);
  if (report.accepted) {
    analysis::accept(state);
  } else {
    reject(state);
    post_mortem_->give_up(state, Stencil::statics());
  }
}

std::pair<PathTangent, solver::Determinant> PathFollowing::find_tangent(Context& context,
                                                                        model::State& state) {
  const Stencil stencil = Stencil::statics();
  context.system.begin_step(state, stencil);
  context.system.evaluate(state, stencil, Want::residual_and_tangent);
  Vector gradient(context.system.layout().row_map());
  Vector flexibility(context.system.layout().row_map());
  context.system.level_gradient(state, stencil, condition_->level_difference(), gradient);
  if (!context.linear.factor()) return {};
  context.linear.solve(gradient, flexibility);
  flexibility.scale(-1.0);
  condition_->find_tangent(state, flexibility);
  refuse_idle_level(state);
  return {*condition_->tangent(), context.linear.determinant()};
}

void PathFollowing::refuse_idle_level(const model::State& state) const {
  if (!condition_->tangent()) return;
  const PathTangent& tangent = *condition_->tangent();
  const bool is_watched = settings_.control == PathControl::displacement;
  if (steps_ == 0 && is_watched && std::isfinite(tangent.level) && tangent.watched == 0.0) {
    throw NumericalError(fmt::format(
        "There is no path to follow by displacement control: at level {:.6g} the watched "
        "displacement of '{}' does not change with the level.\n"
        "Try: another node or direction to watch, or another 'Control'.",
        state.time, settings_.watch->node));
  }
  if (std::isfinite(tangent.level)) return;
  throw NumericalError(fmt::format(
      "There is no path to follow at level {:.6g}: nothing that moves the structure changes with "
      "the level there.\n"
      "Try: a load or prescribed motion with a function that grows with the level, such as "
      "'Ramp'.",
      state.time));
}

bool PathFollowing::is_at_end(const Context& context, const model::State& state) const {
  if (steps_ >= settings_.steps) return true;
  return steps_ > 0 && is_on_target(context, state);
}

bool PathFollowing::is_on_target(const Context& context, const model::State& state) const {
  if (settings_.final_level && state.time == *settings_.final_level) return true;
  return settings_.final_displacement && std::abs(here_.watched - *settings_.final_displacement) <=
                                             1e-9 * context.system.model().length();
}

bool PathFollowing::passed_limit_points() const {
  const auto count = std::count_if(events_.begin(), events_.end(), [](const PathEvent& event) {
    return event.kind == PathEventKind::limit_point;
  });
  return settings_.limit_points && count >= *settings_.limit_points;
}

void PathFollowing::report_early_end(Context& context, const model::State& state) const {
  if (steps_ < settings_.steps || is_on_target(context, state) || passed_limit_points()) return;
  std::vector<std::string> targets;
  if (settings_.final_level) targets.push_back(fmt::format("level {:g}", *settings_.final_level));
  if (settings_.final_displacement) {
    targets.push_back(fmt::format("displacement {:g} m of '{}'", *settings_.final_displacement,
                                  settings_.watch->node));
  }
  if (settings_.limit_points) {
    targets.push_back(fmt::format("limit point {}", *settings_.limit_points));
  }
  if (settings_.at_bifurcation == AtBifurcation::stop) targets.emplace_back("a bifurcation");
  if (targets.empty()) return;
  context.findings.broken(
      "path",
      fmt::format("the path ended at level {:.6g} after {} steps, all that 'Steps' allows, before "
                  "it reached {}",
                  state.time, steps_, join(targets, " or ")),
      state.time);
}

void PathFollowing::land(Context& context, model::State& state, solver::StepOutcome& outcome) {
  const Stencil stencil = Stencil::statics();
  const auto go_on = [&](solver::LevelCondition* condition) {
    context.system.begin_step(state, stencil);
    const solver::StepOutcome landing = newton_->solve(state, stencil, condition);
    outcome.end = landing.end;
    outcome.iterations += landing.iterations;
    outcome.history.insert(outcome.history.end(), landing.history.begin(), landing.history.end());
    outcome.last = landing.last;
    outcome.held_unknown = landing.held_unknown;
  };
  if (settings_.final_level && lies_between(*settings_.final_level, state.time_prev, state.time)) {
    state.time = *settings_.final_level;
    go_on(nullptr);
  }
  if (!settings_.final_displacement || !outcome.converged()) return;
  const double end = *settings_.final_displacement;
  if (lies_between(end, here_.watched, condition_->watched_displacement(state.next))) {
    condition_->begin_to_displacement(end - here_.watched);
    go_on(&*condition_);
  }
}

StepReport PathFollowing::attempt(Context& context, model::State& state) {
  const Stencil stencil = Stencil::statics();
  condition_->begin(size_);
  context.system.begin_step(state, stencil);
  StepReport report;
  report.outcome = newton_->solve(state, stencil, &*condition_);
  refuse_idle_level(state);
  solver::StepOutcome& outcome = report.outcome;
  const auto keep_to_path = [&] {
    if (outcome.converged() && condition_->straightness(state) < least_straightness) {
      outcome.end = StepEnd::off_path;
    }
  };
  keep_to_path();
  if (!outcome.converged()) return report;
  land(context, state, outcome);
  keep_to_path();
  refuse_mirrored(context, state, outcome);
  return report;
}

bool PathFollowing::examine(Context& context, const PathTangent& tangent,
                            const solver::Determinant& determinant) {
  here_.tangent = tangent;
  here_.determinant = determinant;
  is_examined_ = true;
  if (!has_behind_) return false;
  bool ends = false;
  for (const PathEvent& event : find_events(behind_, here_, last_length_)) {
    events_.push_back(event);
    context.log.info(describe(event));
    if (event.kind == PathEventKind::bifurcation) {
      ends = ends || settings_.at_bifurcation == AtBifurcation::stop;
      wants_branch_ = settings_.at_bifurcation == AtBifurcation::follow && !has_branched_;
    }
  }
  return ends || passed_limit_points();
}

// Where a function of loads or motions ends, the path does.
void PathFollowing::refuse_end_of_loads(Context& context, model::State& state) const {
  const Stencil stencil = Stencil::statics();
  Vector above(context.system.layout().row_map());
  Vector below(above.getMap());
  const double step = 10.0 * condition_->level_difference();
  context.system.begin_step(state, stencil);
  context.system.level_gradient(state, stencil, step, above);
  context.system.level_gradient(state, stencil, -step, below);
  const double size = std::max(above.normInf(), below.normInf());
  above.update(-1.0, below, 1.0);
  if (above.normInf() < 0.5 * size) return;
  throw NumericalError(
      fmt::format("The path ends at level {:.6g}: the growth of loads or prescribed motions with "
                  "the level changes abruptly there.\n"
                  "Try: functions without corners, such as 'Ramp'.",
                  state.time));
}

void PathFollowing::take(Context& context, model::State& state, StepReport& report,
                         Observer& observer) {
  const solver::StepOutcome& outcome = report.outcome;
  report.accepted = outcome.converged();
  report.time = state.time;
  report.increment = state.time - state.time_prev;
  report.final_time = std::numeric_limits<double>::infinity();
  if (report.accepted) {
    report.step = ++steps_;
    failures_ = 0;
    last_length_ = condition_->length(state);
    condition_->accept(state);
    behind_ = here_;
    here_ = {state.time, condition_->watched_displacement(state.next), {}, {}};
    has_behind_ = is_examined_;
    is_examined_ = false;
    analysis::accept(state);
    const double factor = std::sqrt(static_cast<double>(settings_.desired_iterations) /
                                    std::max(1, outcome.iterations));
    const double size = std::abs(size_) * std::clamp(factor, 0.25, 2.0);
    const double first = std::abs(first_size_);
    size_ = std::copysign(
        std::clamp(size, settings_.smallest_length * first, settings_.largest_length * first),
        size_);
    report.is_last = is_at_end(context, state);
  } else {
    reject(state);
    report.step = steps_;
    size_ *= ++failures_ == 1 ? 0.5 : 0.25;
  }
  post_mortem_->record(report);
  observer.step(report, state);
  const bool is_exhausted = std::abs(size_) < settings_.smallest_length * std::abs(first_size_);
  if (!report.accepted && (outcome.end == StepEnd::not_finite || is_exhausted)) {
    refuse_end_of_loads(context, state);
    post_mortem_->give_up(state, Stencil::statics());
  }
}

void PathFollowing::switch_branch(Context& context, model::State& state, Observer& observer) {
  const Stencil stencil = Stencil::statics();
  wants_branch_ = false;
  has_branched_ = true;
  context.system.begin_step(state, stencil);
  context.system.evaluate(state, stencil, Want::residual_and_tangent);
  Vector motion(context.system.layout().row_map());
  context.linear.weakest_direction(motion);
  double amplitude = settings_.branch_amplitude.value_or(last_length_);
  constexpr int most_attempts = 8;
  for (int i = 0; i < most_attempts; ++i, amplitude *= 0.5) {
    const double factor = condition_->begin_branch(state, motion, amplitude);
    context.system.begin_step(state, stencil);
    context.system.move(state, motion, factor);
    StepReport report;
    report.outcome = newton_->solve(state, stencil, &*condition_);
    refuse_mirrored(context, state, report.outcome);
    if (!report.outcome.converged()) {
      reject(state);
      continue;
    }
    take(context, state, report, observer);
    has_behind_ = false;  // what lies between is the bifurcation that is known
    context.log.info(fmt::format("on the crossing path from level {:.6g}", state.time));
    return;
  }
  context.findings.warn("branch", "the crossing path was not found; a 'Branch Amplitude' may help",
                        state.time);
}

AnalysisReport PathFollowing::advance(Context& context, model::State& state, Observer& observer) {
  while (!is_at_end(context, state)) {
    StepReport report = attempt(context, state);
    if (!is_examined_ && condition_->tangent()) {
      const bool ends = examine(context, *condition_->tangent(), report.outcome.first_determinant);
      if (ends || wants_branch_) reject(state);
      if (ends) break;
      if (wants_branch_) {
        switch_branch(context, state, observer);
        continue;
      }
    }
    take(context, state, report, observer);
  }
  // reactions, too, are those of this state afterwards
  const auto [tangent, determinant] = find_tangent(context, state);
  const bool is_ended = !is_examined_ && examine(context, tangent, determinant);
  if (!is_ended) report_early_end(context, state);
  return report();
}

std::string PathFollowing::describe(const PathEvent& event) const {
  std::string text = fmt::format("{} at level {:.6g}", name_of(event.kind), event.level);
  if (settings_.watch) {
    text += fmt::format(", displacement of '{}' {:.6g} m", settings_.watch->node, event.watched);
  }
  return text;
}

AnalysisReport PathFollowing::report() const {
  AnalysisReport report;
  report.text = fmt::format("path of {} steps to level {:.6g}\n", steps_, here_.level);
  std::map<std::string, int> counts;
  for (const PathEvent& event : events_) {
    report.text += "  " + describe(event) + "\n";
    const std::string kind = name_of(event.kind);
    const std::string name = fmt::format("{} {}", kind, ++counts[kind]);
    report.numbers.emplace_back(name + ", level", event.level);
    if (settings_.watch) report.numbers.emplace_back(name + ", displacement", event.watched);
  }
  return report;
}

void PathFollowing::save(const Context&, Snapshot& snapshot) const {
  snapshot.set("path/step",
               {static_cast<double>(steps_), size_, first_size_, last_length_,
                is_examined_ ? 1.0 : 0.0, has_behind_ ? 1.0 : 0.0, has_branched_ ? 1.0 : 0.0});
  snapshot.set("path/behind", numbers_of(behind_));
  snapshot.set("path/here", numbers_of(here_));
  std::vector<double> events;
  for (const PathEvent& event : events_) {
    events.insert(events.end(), {static_cast<double>(event.kind), event.level, event.watched});
  }
  snapshot.set("path/events", std::move(events));
  condition_->save(snapshot);
  newton_->save(snapshot);
  post_mortem_->save(snapshot);
}

void PathFollowing::restore(Context& context, const Snapshot& snapshot) {
  make_tools(context);
  const std::vector<double>& step = snapshot.numbers("path/step", 7);
  steps_ = static_cast<int>(step[0]);
  size_ = step[1];
  first_size_ = step[2];
  last_length_ = step[3];
  is_examined_ = step[4] != 0.0;
  has_behind_ = step[5] != 0.0;
  has_branched_ = step[6] != 0.0;
  behind_ = point_of(snapshot.numbers("path/behind", 6));
  here_ = point_of(snapshot.numbers("path/here", 6));
  const std::vector<double>& events = snapshot.numbers("path/events");
  for (std::size_t i = 0; i + 2 < events.size(); i += 3) {
    events_.push_back(
        {static_cast<PathEventKind>(static_cast<int>(events[i])), events[i + 1], events[i + 2]});
  }
  condition_->restore(snapshot);
  newton_->restore(snapshot);
  post_mortem_.emplace(context, snapshot);
}

}  // namespace culm::analysis
