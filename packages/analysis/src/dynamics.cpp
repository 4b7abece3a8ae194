#include <culm/analysis/dynamics.hpp>
#include <culm/analysis/linearisation.hpp>
#include <culm/analysis/newton_options.hpp>
#include <culm/analysis/turning_rotor.hpp>
#include <culm/assembly/rounding.hpp>
#include <culm/base/error.hpp>

#include "mirrored_faces.hpp"
#include "notable_corners.hpp"
#include "turns.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace culm::analysis {

namespace {

Schema adaptive_schema() {
  return Schema("Adaptive",
                "Steps follow an estimate of their error instead of being fixed; the first is a "
                "sixteenth of `Step`. No node turns by more than 53 degrees in a step.")
      .add(number("Tolerance", "1",
                  "Error that a step may add to any position, over the length of the model, or to "
                  "any director.")
               .positive()
               .optional(AdaptiveSettings{}.tolerance))
      .add(number("Largest Step", "s", "Steps do not grow beyond; no limit if absent.")
               .positive()
               .optional());
}

StepSettings step_settings(const Options& options) {
  StepSettings steps;
  steps.end_time = options.number("End Time");
  steps.step = options.number("Step");
  steps.smallest_step =
      options.has("Smallest Step") ? options.number("Smallest Step") : 1e-3 * steps.step;
  if (!options.has_list("Adaptive")) return steps;
  const Options& list = options.list("Adaptive");
  steps.adaptive = AdaptiveSettings{};
  steps.adaptive->tolerance = list.number("Tolerance");
  if (list.has("Largest Step")) steps.adaptive->largest_step = list.number("Largest Step");
  return steps;
}

}  // namespace

std::string late_start(double start, double end) {
  return fmt::format("the analysis starts at {:g}, unless 'Start Time' says otherwise; got {:g}",
                     start, end);
}

Schema Dynamics::schema() {
  return Schema("Dynamic", "Motion in time from the present state and velocity.")
      .add(number("Start Time", "s",
                  "Time at the start, which functions follow; where the analysis before ended if "
                  "absent, and 0 in the first one.")
               .optional())
      .add(number("End Time", "s", "Time at the end.").positive())
      .add(number("Step", "s", "Time step; cut where an iteration fails.").positive())
      .add(number("Smallest Step", "s",
                  "Time step at which cutting ends; a thousandth of the step if absent.")
               .positive()
               .optional())
      .add(choice("Scheme", {"Conserving", "Generalised Alpha", "Trapezoidal"},
                  "Conserving keeps energy and momenta exactly; the others are there to "
                  "compare with.")
               .optional("Conserving"))
      .add(number("Spectral Radius", "1",
                  "Of Generalised Alpha at infinite frequency: 1 damps nothing, 0 most.")
               .between(0.0, 1.0)
               .optional(0.8))
      .check([](const Options& options, InputIssues& issues) {
        const std::string& scheme = options.text("Scheme");
        if (!options.given("Spectral Radius") || scheme == "Generalised Alpha") return;
        issues.add(options.where("Spectral Radius"),
                   "'Scheme' = " + scheme + " has none; only Generalised Alpha damps by it");
      })
      .list("Adaptive", adaptive_schema(), Presence::optional)
      .list("Newton", newton_schema(), Presence::defaulted);
}

std::unique_ptr<Stepper> Dynamics::make(const Options& options, Context& context,
                                        model::State& state) {
  DynamicsSettings settings;
  if (options.has("Start Time")) settings.start_time = options.number("Start Time");
  settings.steps = step_settings(options);
  settings.end_time = options.where("End Time");
  settings.scheme = options.where("Scheme");
  settings.newton = newton_settings(options.list("Newton"));
  std::unique_ptr<TimeScheme> scheme = std::make_unique<ConservingScheme>();
  if (options.text("Scheme") == "Generalised Alpha") {
    scheme = std::make_unique<GeneralisedAlphaScheme>(options.number("Spectral Radius"));
  } else if (options.text("Scheme") == "Trapezoidal") {
    scheme = std::make_unique<TrapezoidalScheme>();
  }
  return std::make_unique<Dynamics>(std::move(settings), std::move(scheme), context, state);
}

Dynamics::Dynamics(DynamicsSettings settings, std::unique_ptr<TimeScheme> scheme, Context& context,
                   model::State& state)
    : Stepper(context, state),
      settings_(std::move(settings)),
      scheme_(std::move(scheme)),
      control_(context.system, settings_.steps, scheme_->error_constant(),
               settings_.steps.adaptive ? notable_corners(context.system.model().functions())
                                        : std::vector<double>()),
      predictor_(context.system),
      certificate_(context.system, scheme_->conserves(), scheme_->shows_work()),
      pulses_(context.system.model()),
      corners_(context.system) {
  state.in_motion = true;
}

// Where momenta are kept at all; what is carried moves stiff parts a little more than rounding
// does.
void Dynamics::keep_balance() {
  system().carry_residuals(scheme_->conserves() && certificate_.is_free());
}

void Dynamics::refuse_other_schemes() const {
  if (scheme_->conserves()) return;
  for (const model::Batch* batch : system().model().batches()) {
    if (!batch->needs_mean_velocity()) continue;
    throw InputError(settings_.scheme, fmt::format("'{}' does not know '{}', which the deck asks "
                                                   "for; allowed: 'Conserving'",
                                                   scheme_->name(), batch->effect().title()));
  }
}

void Dynamics::do_fit() {
  model::State& state = this->state();
  warn_of_turning_part(system().model(), context().log);
  refuse_other_schemes();
  state.time = state.time_prev = settings_.start_time.value_or(state.time);
  if (reaches_end()) {
    throw InputError(settings_.end_time, late_start(state.time, settings_.steps.end_time));
  }
  // beside rows as stiff as those of an analysis before, masses would look like nothing
  system().choose_multiplier_scale(state, Stencil::statics(), Want::mass);
  fit_motion();
}

// Rates are those of the middle of the step whatever the scheme.
void Dynamics::note_lagging_rates() {
  if (scheme_->conserves() || stencil_.theta == 0.5 || !feels_rates(system(), state())) return;
  context().log.info(fmt::format(
      "note: rates of dampers, friction, frames that turn, air and the like are those of the "
      "middle of steps, where '{}' does not balance forces: it is of first order in the step here, "
      "'Conserving' of second",
      scheme_->name()));
}

void Dynamics::do_begin() {
  model::State& state = this->state();
  scheme_->start(model::Coordinates(state.velocity.size()));
  stencil_ = scheme_->begin(state, settings_.steps.step);
  note_lagging_rates();
  system().prepare(state, stencil_);
  system().choose_multiplier_scale(state, stencil_);
  make_post_mortem(state, stencil_);
  do_prepare_resume();
  is_first_ = true;
  certificate_.start(state);
}

// That of a step of the conserving scheme, so short that it hardly changes within. Pulses and noise
// have another value in such a step, so where there are any it is left at zero.
model::Coordinates Dynamics::first_acceleration(double first_step) {
  constexpr double share = 1e-2;  // shorter ones lose digits by their square
  model::State& state = this->state();
  model::Coordinates acceleration(state.velocity.size());
  for (const auto& [name, function] : system().model().functions()) {
    if (!function.is_function_of_time() && function.signal() == nullptr) return acceleration;
  }
  const double step = share * first_step;
  ConservingScheme probe;
  state.time = state.time_prev + step;
  const Stencil stencil = probe.begin(state, step);
  system().prepare(state, stencil);
  if (newton().solve(state, stencil).converged()) {
    const auto found = [&stencil](double, double next, double prev, double offset) {
      return stencil.inertia * (next - prev) + offset;
    };
    model::combine(acceleration, found, state.next, state.prev, state.acceleration_offset);
  } else {
    context().findings.warn(
        "first acceleration",
        fmt::format("no motion was found that begins at {:.6g} s, so scheme '{}' "
                    "begins without acceleration: its first step is of first "
                    "order",
                    state.time_prev, scheme_->name()),
        state.time_prev);
  }
  system().discard(state);
  make_newton(settings_.newton);  // what is rounding in so short a step is none in others
  return acceleration;
}

void Dynamics::do_prepare_resume() {
  make_newton(settings_.newton);
  certificate_effect_ = context().ledger.add("Certificate");
  keep_balance();
}

StepReport Dynamics::do_attempt(double end) {
  model::State& state = this->state();
  if (end <= state.time_prev) {
    throw UsageError(
        fmt::format("a step of time from {:g} s cannot end at {:g} s", state.time_prev, end));
  }
  StepReport report;
  report.increment = end - state.time_prev;
  if (is_behind_corner_ && !corners_.are_within(state.time_prev, end)) strike();
  if (is_first_ && !scheme_->conserves()) scheme_->start(first_acceleration(report.increment));
  report.time = state.time = end;
  stencil_ = scheme_->begin(state, report.increment);
  system().prepare(state, stencil_);
  predictor_.predict(state, report.increment);
  report.outcome = newton().solve(state, stencil_);
  if (report.outcome.converged()) report.outcome.end = control_.judge(state, stencil_);
  if (report.outcome.converged() && settings_.steps.adaptive &&
      pulses_.are_lost(state.time_prev, end, settings_.steps.step)) {
    report.outcome.end = solver::StepEnd::inaccurate;
  }
  refuse_mirrored(context(), state, report.outcome);
  refuse_missed_turns(context(), state, stencil_, report.outcome);
  refuse_turns_apart(context(), state, control_.turn(), report.outcome);
  if (blow_ && report.outcome.converged()) show_blow(report.increment);
  return report;
}

void Dynamics::do_accept(const StepReport& report) {
  model::State& state = this->state();
  const double taken = report.increment;
  pulses_.check(state.time_prev, state.time, context().findings);
  control_.accept(state, taken);
  cut_backs_.accept(taken, control_.turn());
  predictor_.accept(state, taken);
  {
    const Ledger::Scope scope(context().ledger, certificate_effect_);
    // multipliers of the step alone do work over it
    if (blow_) system().move(state, blow_->multipliers, -1.0 / taken);
    certificate_.add_work(state, stencil_, report.outcome.last.constraint_violation);
    if (blow_) certificate_.add_blow(blow_->work);
  }
  is_behind_corner_ = scheme_->conserves() && corners_.in_step(state);
  if (blow_) system().move(state, blow_->multipliers, 1.0 / taken);
  blow_.reset();
  scheme_->finish(state, taken);
  is_first_ = false;
  warn_of_short_step(taken);
  system().accept(state);
  if (!certificate_.is_due()) return;
  const Ledger::Scope scope(context().ledger, certificate_effect_);
  certificate_.compare(state);
}

// Their accelerations are differences of positions over the square of the step, from which the next
// one starts; steps of its own are not so short.
void Dynamics::warn_of_short_step(double taken) {
  constexpr double too_short = 1e-4;
  const double shortest = std::min(too_short * settings_.steps.step, settings_.steps.smallest_step);
  if (scheme_->conserves() || taken >= shortest || reaches_end()) return;
  context().findings.warn(
      "short step",
      fmt::format(
          "a step shorter than {:.3g} s: beside 'Step' = {:g} s, scheme '{}' makes accelerations "
          "of rounding there, which the steps behind it feel; end steps elsewhere, or take "
          "'Conserving'",
          shortest, settings_.steps.step, scheme_->name()),
      state().time);
}

void Dynamics::do_discard() { take_blow_back(); }

bool Dynamics::do_fail(const StepReport& report) {
  take_blow_back();
  control_.reject(report.outcome.end, report.increment);
  predictor_.reject();
  // an error that is too large is the business of adaptive steps
  if (report.outcome.end != solver::StepEnd::inaccurate) {
    cut_backs_.reject(report.outcome.end, predictor_.reversal());
  }
  return control_.is_exhausted();
}

AnalysisReport Dynamics::do_finish() {
  system().carry_residuals(false);
  certificate_.compare_last(state());
  if (!certificate_.broken().empty()) {
    const model::State& now = state();
    const bool has_stepped = stencil_.step > 0.0;  // not where a run is resumed at its end
    if (!has_stepped) {
      const Stencil stencil = Stencil::midpoint(settings_.steps.step);
      system().prepare(state(), stencil);
      system().evaluate(now, stencil, Want::residual_and_tangent);
    }
    certificate_.set_rounding(
        assembly::rounding_energy(system(), {now.prev, now.next, now.multipliers, now.own}));
  }
  measure_hidden_constraints();
  Findings& findings = context().findings;
  if (const std::string broken = certificate_.broken(); !broken.empty()) {
    findings.broken("certificate", "the certificate is broken: " + broken, state().time);
  }
  const std::string hint = cut_backs_.hint(settings_.steps.step);
  if (!hint.empty()) findings.warn("cut-backs", hint, state().time);
  return {certificate_.text(), certificate_.numbers()};
}

void Dynamics::do_save(Snapshot& snapshot) const {
  scheme_->save(system(), snapshot);
  control_.save(snapshot);
  predictor_.save(snapshot);
  cut_backs_.save(snapshot);
  certificate_.save(snapshot);
  pulses_.save(snapshot);
  snapshot.set("dynamics/first", is_first_ ? 1 : 0);
  snapshot.set("dynamics/behind corner", is_behind_corner_ ? 1 : 0);
}

void Dynamics::do_restore(const Snapshot& snapshot) {
  scheme_->restore(system(), snapshot);
  control_.restore(snapshot);
  predictor_.restore(snapshot);
  cut_backs_.restore(snapshot);
  certificate_.restore(snapshot);
  pulses_.restore(snapshot);
  is_first_ = snapshot.integer("dynamics/first") != 0;
  is_behind_corner_ = snapshot.integer("dynamics/behind corner") != 0;
}

}  // namespace culm::analysis
