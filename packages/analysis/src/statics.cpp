#include <culm/analysis/newton_options.hpp>
#include <culm/analysis/statics.hpp>

#include "mirrored_faces.hpp"
#include "shear_range.hpp"
#include "softest_direction.hpp"
#include "take_up.hpp"
#include "turns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::analysis {
namespace {

void check_static_levels(const Options& options, InputIssues& issues) {
  const std::vector<double>& levels = options.numbers("Levels");
  const double final_level = options.number("Final Level");
  if (final_level <= options.number("Start Level")) {
    issues.add(options.where("Final Level"),
               fmt::format("must be above the first level {:g}, got {:g}",
                           options.number("Start Level"), final_level));
    return;
  }
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double before = i == 0 ? options.number("Start Level") : levels[i - 1];
    if (levels[i] <= before || levels[i] > final_level) {
      issues.add(
          options.where("Levels"),
          fmt::format("levels must rise from above the first level to at most the final level "
                      "{:g}, got {:g} after {:g}",
                      final_level, levels[i], before));
      return;
    }
  }
}

// A number that changes when the matrix does.
double fingerprint(const assembly::Matrix& matrix) {
  const assembly::Vector v = irregular(matrix.rows());
  assembly::Vector product(matrix.rows());
  matrix.multiply(v, product);
  return v.dot(product);
}

}  // namespace

Schema Statics::schema() {
  const StaticsSettings defaults;
  return Schema("Static", "Equilibrium under loads that grow with the load level, by load control.")
      .add(number("Start Level", "1",
                  "Load level at the start; above 0 where loads of an analysis before still act.")
               .at_least(0.0)
               .optional(defaults.start_level))
      .add(number("Final Level", "1", "Load level at the end; load functions take it as time.")
               .positive()
               .optional(defaults.final_level))
      .add(integer("Steps", "Equal load steps to the final level, unless a step has to be cut.")
               .at_least(1)
               .optional(10))
      .add(number("Smallest Increment", "1", "Increment of the level at which cutting back ends.")
               .positive()
               .optional(defaults.smallest_increment))
      .add(number("Largest Increment", "1",
                  "Bound on the growth after easy steps; the first increment if absent.")
               .positive()
               .optional())
      .add(integer("Easy Iterations",
                   "Steps with at most so many iterations let the increment grow.")
               .at_least(1)
               .optional(defaults.easy_iterations))
      .add(numbers("Levels", "1", "Levels to be met exactly, rising.")
               .optional(std::vector<double>{}))
      .list("Newton", newton_schema(), Presence::defaulted)
      .check(check_static_levels);
}

std::unique_ptr<Stepper> Statics::make(const Options& options, Context& context,
                                       model::State& state) {
  StaticsSettings settings;
  settings.final_level = options.number("Final Level");
  settings.start_level = options.number("Start Level");
  settings.increment = (settings.final_level - settings.start_level) / options.integer("Steps");
  settings.smallest_increment = options.number("Smallest Increment");
  settings.largest_increment =
      options.has("Largest Increment") ? options.number("Largest Increment") : settings.increment;
  settings.easy_iterations = options.integer("Easy Iterations");
  settings.levels = options.numbers("Levels");
  settings.newton = newton_settings(options.list("Newton"));
  return std::make_unique<Statics>(std::move(settings), context, state);
}

Statics::Statics(StaticsSettings settings, Context& context, model::State& state)
    : Stepper(context, state), settings_(std::move(settings)) {
  const model::Model& model = context.system.model();
  const bool remembers = std::ranges::any_of(
      model.batches(), [](const model::Batch* batch) { return batch->depends_on_path(); });
  if (remembers) pulses_.emplace(model);
}

// The next level on the way, not passing one that must be met; leaves no sliver before it.
double Statics::next_level(double level, double increment) const {
  double bound = settings_.final_level;
  for (auto at = settings_.levels.rbegin(); at != settings_.levels.rend(); ++at) {
    if (*at > level * (1.0 + 1e-12)) bound = *at;
  }
  const double rest = bound - level;
  if (rest <= increment * (1.0 + 1e-9)) return bound;
  return on_grid(rest < 1.5 * increment ? level + 0.5 * rest : level + increment);
}

// Equal steps meet the levels that the deck means. Those of sums of increments are off by rounding,
// which would decide whether a function that jumps there acts.
double Statics::on_grid(double level) const {
  const double range = settings_.final_level - settings_.start_level;
  const double steps = std::round(range / settings_.increment);
  const double step = (level - settings_.start_level) / range * steps;
  const double nearest = std::round(step);
  constexpr double rounding = 1e-9;
  if (std::abs(step - nearest) > rounding || nearest == 0.0) return level;
  return settings_.start_level + range * nearest / steps;
}

void Statics::do_begin() {
  const Stencil stencil = Stencil::statics();
  for (const model::Constraint& c : system().model().constraints()) {
    if (c.velocity_rows.empty()) continue;
    context().log.warning(
        fmt::format("{} '{}' acts in dynamics only; statics knows no velocity", c.type, c.name));
  }
  state().time = state().time_prev = settings_.start_level;
  // what is brought into equilibrium is at rest, also for a motion that comes after
  state().velocity.release(0, state().velocity.size());
  increment_ = settings_.increment;
  system().prepare(state(), stencil);
  system().choose_multiplier_scale(state(), stencil);
  make_post_mortem(state(), stencil, proposal());
  hangs_ = post_mortem().is_singular();
  // of the state without the first load: under stresses that come by themselves, as those of heat
  // do, the first iteration may lie beyond a bifurcation already
  if (system().layout().rows().total() > 0 && !hangs_) {
    const solver::Determinant first = context().linear.determinant();
    determinant_sign_ = first.sign;
    first_log_size_ = first.log_size;
    tell_unwatched(first.sign != 0);
  }
  make_newton(settings_.newton);
  newton().hold_free(hangs_);
  if (hangs_) try_hanging();
}

// Where stability may be lost without a word.
void Statics::tell_unwatched(bool has_determinant) {
  if (!has_determinant) {
    context().log.info(
        fmt::format("note: '{}' knows no determinants, so whether equilibria are stable is not "
                    "watched",
                    context().linear.name()));
  } else if (settings_.newton.refresh == solver::Refresh::on_slow_convergence) {
    context().log.info(
        "note: with 'Refresh' = On Slow Convergence, whether equilibria are stable is watched only "
        "in steps that begin with new factors");
  }
}

// Whether the first step leads to where nothing moves freely any more must be known before there
// are results.
void Statics::try_hanging() {
  const bool holds = do_attempt(proposal()).outcome.converged();
  system().discard(state());
  newton().go_back();
  if (!holds) post_mortem().refuse_singular();
}

StepReport Statics::do_attempt(double level) {
  const Stencil stencil = Stencil::statics();
  state().time = level;
  system().prepare(state(), stencil);
  StepReport report;
  report.time = level;
  report.increment = level - state().time_prev;
  report.outcome = newton().solve(state(), stencil);
  refuse_mirrored(context(), state(), report.outcome);
  refuse_missed_turns(context(), state(), stencil, report.outcome);
  if (hangs_ && report.outcome.converged() &&
      (flies_away() || post_mortem().is_singular(state(), stencil))) {
    report.outcome.end = solver::StepEnd::singular;
  }
  return report;
}

// What hangs from a hinge comes as far as it is long.
bool Statics::flies_away() {
  constexpr double far = 3.0;  // lengths of the model
  double most = 0.0;
  const int nodes = static_cast<int>(state().next.size() / 12);
  for (int node = 0; node < nodes; ++node) {
    const Vec3 way = model::NodeTable::slots(state().next, node).col(0) -
                     model::NodeTable::slots(state().prev, node).col(0);
    most = std::max(most, way.norm());
  }
  return system().comm().max(most) > far * system().model().length();
}

void Statics::do_accept(const StepReport& report) {
  watch_stability(report);
  if (pulses_) pulses_->check_turns(state().time_prev, state().time, context().findings);
  system().accept(state());
  if (hangs_) note_hanging();
  if (report.outcome.iterations <= settings_.easy_iterations && report.increment >= increment_) {
    increment_ = std::min(1.5 * increment_, settings_.largest_increment);
  }
}

void Statics::note_hanging() {
  hangs_ = false;
  newton().hold_free(false);
  system().prepare(state(), Stencil::statics());
  if (!reaches_end()) make_post_mortem(state(), Stencil::statics(), proposal());
  context().log.info(
      fmt::format("note: nothing resisted some motion before the first step, as where something "
                  "hangs from a hinge; at level {:g} what it carries does",
                  state().time));
}

void Statics::explain_failure() {
  if (hangs_) post_mortem().refuse_singular();
}

bool Statics::do_fail(const StepReport& report) {
  if (hangs_)
    return true;  // a load moves what is free at any size, and what hangs straight at none
  increment_ = 0.5 * report.increment;
  trend_.add(state().time);
  if (increment_ >= settings_.smallest_increment && !dead_end()) return false;
  const bool is_first = state().time_prev == settings_.start_level;
  if (!is_first || !may_take_up_) return true;
  // smaller increments of the level do not make smaller what acts at the start
  may_take_up_ = false;
  if (take_up(context(), newton(), state()) != TakeUp::done) return true;
  increment_ = settings_.increment;
  return false;
}

void Statics::do_save(Snapshot& snapshot) const {
  snapshot.set("statics/increment", increment_);
  snapshot.set("statics/determinant sign", determinant_sign_);
  snapshot.set("statics/crossings", crossings_);
  snapshot.set("statics/first log size", first_log_size_);
  snapshot.set("statics/unstable pair", has_unstable_pair_ ? 1 : 0);
  snapshot.set("statics/hangs", hangs_ ? 1 : 0);
  trend_.save(snapshot);
  if (pulses_) pulses_->save(snapshot);
}

void Statics::do_restore(const Snapshot& snapshot) {
  may_take_up_ = true;
  increment_ = snapshot.number("statics/increment");
  determinant_sign_ = snapshot.integer("statics/determinant sign");
  crossings_ = snapshot.copy("statics/crossings");
  first_log_size_ = snapshot.number("statics/first log size");
  has_unstable_pair_ = snapshot.integer("statics/unstable pair") != 0;
  hangs_ = snapshot.integer("statics/hangs") != 0;
  newton().hold_free(hangs_);
  trend_.restore(snapshot);
  if (pulses_) pulses_->restore(snapshot);
}

// A pivot that is nothing but rounding has any sign, as where a structure may be turned freely.
bool Statics::is_singular() {
  constexpr double rounding = 1e-13;
  assembly::Vector motion(system().layout().rows());
  return context().linear.weakest_direction(motion) < rounding &&
         resistance(*system().matrix(), motion) < least_resistance;
}

// Stresses may grow where nothing moves, as those of a heated bar between two walls: then no
// iteration has factored anything. The last iteration began before the equilibrium, so that a step
// of one iteration tells of its start; at the end there is none to follow.
int Statics::find_determinant_sign(const StepReport& report) {
  const int iterations = report.outcome.iterations;
  const bool is_behind = iterations == 1 && is_last(report);
  if ((iterations > 0 && !is_behind) || determinant_sign_ == 0) {
    return report.outcome.last_determinant.sign;
  }
  const double before = is_behind ? fingerprint(*system().matrix()) : 0.0;
  system().evaluate(state(), Stencil::statics(), Want::residual_and_tangent);
  constexpr double rounding = 1e-13;
  if (is_behind &&
      std::abs(fingerprint(*system().matrix()) - before) <= rounding * std::abs(before)) {
    return report.outcome.last_determinant.sign;  // of a linear structure: it is the same
  }
  return context().linear.factor() ? context().linear.determinant().sign : 0;
}

void Statics::watch_pairs(const StepReport& report) {
  const solver::Determinant& last = report.outcome.last_determinant;
  const bool may_be = last.negative || last.log_size < first_log_size_ || is_last(report);
  if (has_unstable_pair_ || !crossings_.empty() || !may_be ||
      !sets_energy_free(system(), context().linear)) {
    return;
  }
  // the last iteration may have begun far from the equilibrium, as where heat presses at first
  system().evaluate(state(), Stencil::statics(), Want::residual_and_tangent);
  if (!context().linear.factor() || !sets_energy_free(system(), context().linear)) return;
  has_unstable_pair_ = true;
  context().findings.warn(
      "stability",
      fmt::format("by level {:.6g} the stiffness in one direction is negative, although the "
                  "determinant has kept its sign: two directions lost theirs, and the equilibrium "
                  "that was found is unstable; an analysis of type 'Buckling' shows where",
                  report.time),
      report.time);
}

void Statics::watch_stability(const StepReport& report) {
  int sign = find_determinant_sign(report);
  if (sign == 0) return;
  if (determinant_sign_ == 0) {
    determinant_sign_ = report.outcome.first_determinant.sign;
    first_log_size_ = report.outcome.first_determinant.log_size;
  }
  if (sign == determinant_sign_) {
    watch_pairs(report);
    return;
  }
  // the last iteration began before the equilibrium, where a blade that turns may not be stretched
  system().evaluate(state(), Stencil::statics(), Want::residual_and_tangent);
  sign = context().linear.factor() ? context().linear.determinant().sign : 0;
  if (sign == 0 || sign == determinant_sign_ || is_singular()) return;
  determinant_sign_ = sign;
  crossings_.push_back(report.time);
  context().findings.warn(
      "stability",
      fmt::format("between the levels {:.6g} and {:.6g} the determinant of the stiffness changes "
                  "its sign: a limit point or a bifurcation was passed, and the equilibrium that "
                  "was found may be unstable or lie on another path; an analysis of type 'Path' "
                  "shows what is there",
                  report.time - report.increment, report.time),
      report.time);
}

AnalysisReport Statics::do_finish() {
  warn_of_shear(context(), state());
  AnalysisReport report;
  for (const double level : crossings_) {
    report.text += fmt::format(
        "the determinant of the stiffness changed its sign in the step to level {:.6g}\n", level);
  }
  if (!crossings_.empty()) {
    report.numbers.emplace_back("sign changes of the determinant",
                                static_cast<double>(crossings_.size()));
  }
  return report;
}

}  // namespace culm::analysis
