#include <culm/analysis/dynamics.hpp>
#include <culm/analysis/newton_options.hpp>
#include <culm/analysis/turning_rotor.hpp>
#include <culm/base/error.hpp>

#include "mirrored_faces.hpp"
#include "missed_pulses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

double largest(const std::vector<double>& v) {
  double result = 0.0;
  for (double entry : v) result = std::max(result, std::abs(entry));
  return result;
}

}  // namespace

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
      .list("Adaptive", adaptive_schema(), Presence::optional)
      .list("Newton", newton_schema(), Presence::defaulted);
}

std::unique_ptr<Analysis> Dynamics::make(const Options& options) {
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
  return std::make_unique<Dynamics>(std::move(settings), std::move(scheme));
}

namespace {

assembly::System::Solve mass_solver(Context& context, const model::State& state) {
  return [&](const assembly::Vector& b, assembly::Vector& x) {
    if (!context.linear.factor() || context.linear.solve(b, x) > 1e-8) {
      PostMortem::refuse_massless(context, state);
    }
  };
}

// Where velocities changed most, and what they did not fit: the equation that was violated most, or
// the support that holds the node.
std::string describe_place(const model::Model& model, const assembly::VelocityFit& fit) {
  if (fit.node < 0) return {};
  std::string text = fmt::format(" at '{}'", model.node_name(fit.node));
  const model::Constraint* cause = nullptr;
  if (fit.equation >= 0) cause = &model.equations()[static_cast<std::size_t>(fit.equation)];
  for (const model::Constraint& c : model.constraints()) {
    if (cause == nullptr && c.fix && model.nodes().master(c.fix->node) == fit.node) cause = &c;
  }
  if (cause != nullptr && !cause->name.empty())
    text += fmt::format(", by {} '{}'", cause->type, cause->name);
  return text;
}

// The deck may displace bodies out of their joints.
void close_joints(Context& context, model::State& state) {
  const double change = context.system.project_position(state, mass_solver(context, state));
  if (std::isinf(change)) {
    throw NumericalError(
        "No position fits the constraints near the initial displacements.\n"
        "Try: displace the bodies of a closed loop so that its joints nearly meet.");
  }
  if (change > 1e-9 * context.system.model().length()) {
    context.log.info(fmt::format(
        "note: initial displacements were made to fit the constraints; largest change {:.3g}",
        change));
  }
}

}  // namespace

// Motion that constraints do not allow would never decay, so it is removed.
void Dynamics::fit_motion(Context& context, model::State& state) const {
  if (state.at_rest && context.system.model().has_initial_displacements()) {
    close_joints(context, state);
  }
  state.acceleration_offset.assign(state.velocity.size(), 0.0);
  // what a motion ends with fulfils the constraints to the second order of its step only
  const double tolerance = state.at_rest ? 1e-9 : 1e-4;
  // the deck's velocities belong to the first motion; a later analysis goes on with what it finds
  if (state.at_rest) context.system.model().add_initial_velocities(state.next, state.velocity);
  state.at_rest = false;
  const assembly::VelocityFit fit = context.system.project_velocity(
      state, 1e-4 * settings_.steps.step, mass_solver(context, state));
  if (fit.change > tolerance * std::max(1.0, largest(state.velocity))) {
    context.findings.warn(
        "initial velocities",
        fmt::format("initial velocities were made to fit the constraints; largest change {:.3g}",
                    fit.change) +
            describe_place(context.system.model(), fit),
        state.time);
  }
}

// On a copy: the state's own energy would change.
void Dynamics::measure_hidden_constraints(Context& context, const model::State& state) {
  model::State copy = state;
  bool sound = true;  // a closed loop may just pass a singular position
  const assembly::VelocityFit fit = context.system.project_velocity(
      copy, 1e-4 * settings_.steps.step, [&](const assembly::Vector& b, assembly::Vector& x) {
        sound = context.linear.factor() && context.linear.solve(b, x) <= 1e-8;
        if (!sound) x.putScalar(0.0);
      });
  if (sound) certificate_->finish(fit.change, context.system.comm().max(largest(copy.velocity)));
}

void Dynamics::fit(Context& context, model::State& state) {
  warn_of_turning_part(context.system.model(), context.log);
  assembly::System& system = context.system;
  if (system.velocity_dissipation() != nullptr && !scheme_->conserves()) {
    throw InputError(settings_.scheme,
                     fmt::format("'{}' does not know the 'Velocity Dissipation' that a structure "
                                 "asks for; allowed: 'Conserving'",
                                 scheme_->name()));
  }
  state.time = state.time_prev = settings_.start_time.value_or(state.time);
  if (state.time >= settings_.steps.end_time) {
    throw InputError(settings_.end_time,
                     fmt::format("the analysis starts at {:g}, unless 'Start Time' says otherwise; "
                                 "got {:g}",
                                 state.time, settings_.steps.end_time));
  }
  fit_motion(context, state);
}

void Dynamics::start(Context& context, model::State& state) {
  assembly::System& system = context.system;
  scheme_->start(state);
  system.drop_residual();
  control_.emplace(system, settings_.steps, scheme_->error_constant());
  predictor_.emplace(system);
  steps_ = 0;
  cut_backs_ = {};
  const Stencil stencil = scheme_->begin(state, settings_.steps.step);
  system.begin_step(state, stencil);
  system.choose_multiplier_scale(state, stencil);
  post_mortem_.emplace(context, state, stencil);
  newton_.emplace(system, context.linear, settings_.newton, context.ledger);
  certificate_.emplace(system, scheme_->conserves());
  certificate_->start(state);
}

void Dynamics::save(const Context& context, Snapshot& snapshot) const {
  snapshot.set("dynamics/steps", steps_);
  scheme_->save(context.system, snapshot);
  control_->save(snapshot);
  predictor_->save(snapshot);
  cut_backs_.save(snapshot);
  newton_->save(snapshot);
  certificate_->save(snapshot);
  post_mortem_->save(snapshot);
}

void Dynamics::restore(Context& context, const Snapshot& snapshot) {
  assembly::System& system = context.system;
  steps_ = snapshot.integer("dynamics/steps");
  scheme_->restore(snapshot);
  control_.emplace(system, settings_.steps, scheme_->error_constant());
  predictor_.emplace(system);
  control_->restore(snapshot);
  predictor_->restore(snapshot);
  cut_backs_.restore(snapshot);
  newton_.emplace(system, context.linear, settings_.newton, context.ledger);
  newton_->restore(snapshot);
  certificate_.emplace(system, scheme_->conserves());
  certificate_->restore(snapshot);
  post_mortem_.emplace(context, snapshot);
}

AnalysisReport Dynamics::advance(Context& context, model::State& state, Observer& observer) {
  assembly::System& system = context.system;
  const double end_time = settings_.steps.end_time;
  const Ledger::Id certificate_effect = context.ledger.add("Certificate");
  // where momenta are kept at all; what is carried moves stiff parts a little more than rounding
  // does
  const bool carries = scheme_->conserves() && certificate_->is_free();
  MissedPulses pulses(system.model().functions());
  while (state.time < end_time) {
    state.time = control_->end_of_step(state.time_prev);
    const double taken = state.time - state.time_prev;
    const Stencil stencil = scheme_->begin(state, taken);
    system.begin_step(state, stencil);
    predictor_->predict(state, taken);
    StepReport report{steps_, state.time, end_time, taken, true, newton_->solve(state, stencil)};
    if (report.outcome.converged()) report.outcome.end = control_->judge(state, stencil);
    refuse_mirrored(context, state, report.outcome);
    report.accepted = report.outcome.converged();
    if (report.accepted) {
      report.step = ++steps_;
      report.is_last = state.time >= end_time;
      pulses.check(state.time_prev, state.time, context.log);
      control_->accept(state, taken);
      cut_backs_.accept(taken, control_->turn());
      predictor_->accept(state, taken);
      if (carries) system.carry_residual(taken);
      scheme_->finish(state, taken);
      if (model::VelocityDissipation* dissipation = system.velocity_dissipation()) {
        dissipation->correct(state, taken);
      }
      {
        const Ledger::Scope scope(context.ledger, certificate_effect);
        certificate_->record(state, stencil, report.outcome.last.constraint_violation,
                             report.is_last);
      }
      accept(state);
    } else {
      control_->reject(report.outcome.end, taken);
      predictor_->reject();
      reject(state);
      // an error that is too large is the business of adaptive steps
      if (report.outcome.end != solver::StepEnd::inaccurate) {
        cut_backs_.reject(report.outcome.end, predictor_->reversal());
      }
    }
    post_mortem_->record(report);
    observer.step(report, state);
    const bool not_finite = report.outcome.end == solver::StepEnd::not_finite;
    if (!report.accepted && (not_finite || control_->is_exhausted())) {
      post_mortem_->give_up(state, stencil);
    }
  }
  system.drop_residual();
  measure_hidden_constraints(context, state);
  if (const std::string broken = certificate_->broken(); !broken.empty()) {
    context.findings.broken("certificate", "the certificate is broken: " + broken, state.time);
  }
  const std::string hint = cut_backs_.hint(settings_.steps.step);
  if (!hint.empty()) context.findings.warn("cut-backs", hint, state.time);
  return {certificate_->text(), certificate_->numbers()};
}

}  // namespace culm::analysis
