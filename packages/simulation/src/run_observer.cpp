#include "run_observer.hpp"

#include <culm/analysis/unknown_names.hpp>
#include <culm/base/absent.hpp>
#include <culm/base/error.hpp>
#include <culm/base/version.hpp>

#include "air_words.hpp"
#include "coupled_run.hpp"
#include "finite.hpp"
#include "memories.hpp"
#include "other_run.hpp"
#include "served_run.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace culm::simulation {
namespace {

// Share of the largest force that rounding may leave out of balance without a word.
constexpr double notable_imbalance = 1e-5;

// The ledger as numbers; what makes no sense for an effect is absent.
output::NamedTable effects_table(const Ledger& ledger) {
  output::NamedTable table{
      "effects", {"items", "unknowns", "entries per iteration", "calls", "time [s]"}, {}, {}};
  const auto number = [](const std::optional<long long>& count) {
    return count ? static_cast<double>(*count) : absent;
  };
  for (const Ledger::Entry& e : ledger.entries()) {
    table.rows.push_back({number(e.items), number(e.unknowns), number(e.entries_per_iteration),
                          static_cast<double>(e.calls), e.seconds});
    table.remarks.push_back(e.name);
  }
  return table;
}

}  // namespace

RunObserver::RunObserver(Ledger& ledger, Findings& findings, ResultFiles& files,
                         Checkpoints* checkpoints, const DeckSource& source,
                         const EarlierStates& earlier, const Imperfections& imperfections,
                         const analysis::ElementTurn& reference_turn, Progress progress)
    : ledger_(ledger),
      findings_(findings),
      files_(files),
      checkpoints_(checkpoints),
      source_(source),
      earlier_(earlier),
      imperfections_(imperfections),
      reference_turn_(reference_turn),
      turn_(reference_turn),
      progress_(std::move(progress)),
      quantities_effect_(ledger.add("Quantities")),
      history_effect_(ledger.add("Output, history")),
      states_effect_(ledger.add("Output, states")) {
  if (checkpoints_ != nullptr && checkpoints_->are_active())
    checkpoint_effect_ = ledger.add("Checkpoints");
}

void RunObserver::begin(const Options& entry, std::size_t number, bool is_last,
                        analysis::Context& context, const solver::ChosenSolver& linear_solver) {
  name_ = entry.name();
  progress_.begin(name_);
  findings_.begin(name_);
  loads_.begin(context.system.model());
  ranges_.begin(context.system.model());
  waves_.begin(context.system.model());
  shells_.begin(context.system.model());
  strips_.begin(context.system.model());
  balance_ = {};
  context_ = &context;
  linear_solver_ = &linear_solver;
  turns_.emplace(context.system);
  stepper_ = nullptr;
  number_ = number;
  is_last_ = is_last;
  keeps_end_ = false;
  has_stepped_ = false;
}

void RunObserver::resume(const Snapshot& snapshot) {
  loads_.restore(snapshot);
  ranges_.restore(snapshot);
  waves_.restore(snapshot);
  const std::span<const double> balance = snapshot.numbers("run/balance", 3);
  balance_.scale = balance[0];
  balance_.residual = balance[1];
  balance_.time = balance[2];
  balance_.row = snapshot.text("run/balance row");
}

void RunObserver::start_run(model::State& state, bool steps_follow) {
  if (has_started_) return;
  has_started_ = is_recorded_ = true;
  record(state.time, 0, state, false);
  if (!steps_follow) start(state);
}

void RunObserver::start(model::State& state) {
  start_run(state, true);
  has_history_ = true;
  model::State first = unsolved(files_.model(), state);
  add_history(state.time, 0, first);
}

void RunObserver::add_history(double time, int step, model::State& state) {
  std::vector<double> numbers;
  {
    const Ledger::Scope scope(ledger_, quantities_effect_);
    numbers = files_.evaluate(state);
    if (!is_finite(numbers)) {
      const std::string when =
          step == 0 ? "at the start"
                    : fmt::format("in step {} of '{}', at {:.8g}", step, name_, time);
      refuse_infinite(files_.columns(), numbers, when);
    }
    if (step > 0) {
      for (const std::string& doubt : files_.doubts()) findings_.warn("history", doubt, time);
    }
  }
  const Ledger::Scope scope(ledger_, history_effect_);
  shown_ = numbers;
  files_.add_history({time, numbers, static_cast<int>(number_), step});
  if (shows_each_step_) files_.show_history();
}

void RunObserver::record(double time, int step, const model::State& state, bool was_solved) {
  const Ledger::Scope scope(ledger_, states_effect_);
  files_.record(time, static_cast<int>(number_), step, state, was_solved);
}

void RunObserver::pass(const analysis::StepReport& report) {
  const auto& outcome = report.outcome;
  iterations_ += outcome.iterations;
  if (!report.accepted) {
    ++rejected_;
    return;
  }
  ++accepted_;
  ++passed_;
  most_iterations_ = std::max(most_iterations_, outcome.iterations);
  worst_residual_ = std::max(worst_residual_, outcome.history.back().force);
  worst_constraint_ = std::max(worst_constraint_, outcome.history.back().constraint);
  steps_.rows.push_back({report.time, static_cast<double>(outcome.iterations),
                         outcome.history.back().force, outcome.held_unknown ? 1.0 : 0.0,
                         static_cast<double>(number_), static_cast<double>(report.step)});
  balance_.scale = std::max(balance_.scale, outcome.last.force_scale);
  if (outcome.held_unknown) add_held(report);
}

void RunObserver::step(const analysis::StepReport& report, model::State& state) {
  has_stepped_ = false;
  if (report.accepted) {
    is_recorded_ = true;  // a state beyond the range of numbers is none to keep or to go on from
    add_history(report.time, report.step, state);
  }
  pass(report);
  if (report.accepted) {
    watch_turns(report.time, state);
    shells_.step(context_->system, state, name_);
    watch_loads(report, state);
    is_recorded_ = files_.is_due(accepted_ - passed_, accepted_) || report.is_last;
    passed_ = 0;
    if (is_recorded_) record(report.time, report.step, state, true);
  }
  has_stepped_ = true;
  progress_.show(report);
  if (checkpoints_ == nullptr) return;
  const Checkpoints::Demand demand = checkpoints_->demand();
  const bool ends = keeps_end_ && report.is_last;
  if (demand == Checkpoints::Demand::none && !ends) return;
  if (served_ == nullptr) write_checkpoint();
  if (demand != Checkpoints::Demand::stop) return;
  has_said_farewell_ = true;
  throw Stopped(checkpoints_->farewell());
}

void RunObserver::add_held(const analysis::StepReport& report) {
  const solver::StepOutcome& outcome = report.outcome;
  const double share = outcome.history.back().force;
  const double residual = outcome.last.force_residual;
  ++held_;
  if (share <= worst_held_ && residual <= balance_.residual) return;
  const std::string row = analysis::UnknownNames(context_->system).name_of(*outcome.held_unknown);
  if (share > worst_held_) {
    worst_held_ = share;
    worst_held_row_ = row;
  }
  if (residual > balance_.residual) {
    balance_.residual = residual;
    balance_.time = report.time;
    balance_.row = row;
  }
}

// A turn that grows a little from step to step is not looked up in each.
void RunObserver::watch_turns(double time, const model::State& state) {
  constexpr double noticeable = 1.001;
  const double share = turns_->largest_share(state.next);
  if (share <= noticeable * turn_.share) return;
  turn_.share = share;
  if (share <= 1.0) return;
  turn_ = turns_->find(state.next, share);
  turn_.place = fmt::format("at {:.6g} of '{}'", time, name_);
  // an error that grows is told with its largest value, at the end; that nothing is true any more
  // at once
  if (!turn_.is_meaningless() || reference_turn_.is_meaningless()) return;
  if (!has_told_turn_) findings_.broken("turned element", turn_.warning(), time);
  has_told_turn_ = true;
}

bool RunObserver::write_checkpoint() {
  if (checkpoints_ == nullptr || !checkpoints_->are_active() || !has_stepped_) return false;
  const Ledger::Scope scope(ledger_, checkpoint_effect_);
  Snapshot snapshot(Snapshot::Use::shared);
  save(snapshot);
  stepper_->save(snapshot);
  if (coupled_ != nullptr) coupled_->save(snapshot);
  if (served_ != nullptr) served_->save(snapshot);
  files_.save(snapshot);
  checkpoints_->write(snapshot);
  kept_ = stepper_->time();
  return true;
}

std::string RunObserver::way_on() const {
  if (!kept_) return {};
  return fmt::format("\nGo on with: {}, from {:g} s", checkpoints_->way_on(), *kept_);
}

void RunObserver::save(Snapshot& snapshot) const {
  snapshot.set("format", checkpoint_format);
  snapshot.set_text("run/version", std::string(version));
  snapshot.set("run/ranks", context_->system.comm().size());
  snapshot.set("run/analysis", static_cast<double>(number_));
  save_structures(context_->system.model(), snapshot);
  save_memory_owners(context_->system.model(), snapshot);
  source_.save(snapshot);
  findings_.save(snapshot);
  loads_.save(snapshot);
  ranges_.save(snapshot);
  waves_.save(snapshot);
  shells_.save(snapshot);
  snapshot.set("run/balance", {balance_.scale, balance_.residual, balance_.time});
  snapshot.set_text("run/balance row", balance_.row);
  earlier_.save(snapshot);
  imperfections_.save(snapshot);
  snapshot.set(
      "run/counts",
      {static_cast<double>(accepted_), static_cast<double>(rejected_),
       static_cast<double>(iterations_), static_cast<double>(most_iterations_), worst_residual_,
       worst_constraint_, is_recorded_ ? 1.0 : 0.0, static_cast<double>(held_), worst_held_});
  snapshot.set_text("run/held row", worst_held_row_);
  snapshot.set_text("run/certificates", certificates_);
  turn_.save(snapshot);
  if (has_told_turn_) snapshot.set("run/has told turn", 1.0);
  std::vector<double> steps;
  for (const auto& row : steps_.rows) steps.insert(steps.end(), row.begin(), row.end());
  snapshot.set("run/steps", std::move(steps));
  std::vector<double> values;
  for (const output::NamedScalar& scalar : numbers_) {
    snapshot.set_text("run/number " + std::to_string(values.size()), scalar.name);
    values.push_back(scalar.value);
  }
  snapshot.set("run/numbers", std::move(values));
}

void RunObserver::keep(Snapshot& snapshot) const {
  save(snapshot);
  files_.save(snapshot);
  snapshot.set(shown_key, shown_);
}

void RunObserver::go_back(const Snapshot& kept) {
  if (!files_.has_saved(kept)) {
    throw UsageError("the snapshot knows nothing of the results that are written here");
  }
  files_.go_back(kept);
  steps_.rows.clear();
  numbers_.clear();
  restore(kept);
  resume(kept);
  const std::span<const double> shown = kept.numbers(shown_key);
  shown_.assign(shown.begin(), shown.end());
}

void RunObserver::restore(const Snapshot& snapshot) {
  has_started_ = has_history_ = true;
  const std::span<const double> counts = snapshot.numbers("run/counts", 9);
  accepted_ = static_cast<int>(counts[0]);
  rejected_ = static_cast<int>(counts[1]);
  iterations_ = static_cast<int>(counts[2]);
  most_iterations_ = static_cast<int>(counts[3]);
  worst_residual_ = counts[4];
  worst_constraint_ = counts[5];
  is_recorded_ = counts[6] != 0.0;
  held_ = static_cast<int>(counts[7]);
  worst_held_ = counts[8];
  worst_held_row_ = snapshot.text("run/held row");
  certificates_ = snapshot.text("run/certificates");
  turn_.restore(snapshot);
  has_told_turn_ = snapshot.has("run/has told turn");
  shells_.restore(snapshot);
  const std::span<const double> steps = snapshot.numbers("run/steps");
  const std::size_t columns = steps_.columns.size();
  for (std::size_t i = 0; i + columns <= steps.size(); i += columns) {
    const auto row = steps.begin() + static_cast<std::ptrdiff_t>(i);
    steps_.rows.emplace_back(row, row + static_cast<std::ptrdiff_t>(columns));
  }
  const std::span<const double> values = snapshot.numbers("run/numbers");
  for (std::size_t i = 0; i < values.size(); ++i) {
    numbers_.push_back({snapshot.text("run/number " + std::to_string(i)), "", values[i]});
  }
}

void RunObserver::finish(const analysis::AnalysisReport& report, const model::State& state) {
  refuse_infinite(name_, report);
  record_early_end(state);
  loads_.report(state, is_last_, findings_);
  ranges_.report(state.time, findings_);
  strips_.step(state, findings_);  // of an analysis that makes no steps
  report_rounding();
  {
    const Ledger::Scope scope(ledger_, states_effect_);
    files_.add_results(name_, report, state);
  }
  certificates_ += report.text;
  air_ = describe_air(context_->system.model());
  const std::string before = free_prefix();
  for (const auto& [name, value] : report.numbers) numbers_.push_back({before + name, "", value});
}

// Who makes the steps may end them before the last one, which is recorded whatever its number.
void RunObserver::record_early_end(const model::State& state) {
  if (stepper_ == nullptr || is_recorded_) return;
  is_recorded_ = true;
  record(state.time, stepper_->steps(), state, stepper_->has_reactions());
}

// What sets the numbers of an analysis apart from those before it, which may have had its name: a
// program can take up an analysis again.
std::string RunObserver::free_prefix() const {
  if (numbers_.empty()) return {};
  std::string prefix = name_ + ": ";
  const auto is_taken = [&](const output::NamedScalar& one) {
    return one.name.starts_with(prefix);
  };
  for (int time = 2; std::ranges::any_of(numbers_, is_taken); ++time) {
    prefix = fmt::format("{} ({}): ", name_, time);
  }
  return prefix;
}

// Loads of a step, such as impulses, are asked for by both of its ends, others where they act.
void RunObserver::watch_loads(const analysis::StepReport& report, model::State& state) {
  const double accepted = state.time_prev;
  state.time_prev = report.time - report.increment;
  loads_.step(context_->system, state, stepper_->last_stencil().theta, balance_.residual);
  strips_.step(state, findings_);
  state.time_prev = accepted;
  ranges_.step(context_->system);
  waves_.step(state);
}

// Positions are right to the last digit then, forces are not.
void RunObserver::report_rounding() {
  // where nothing acts, forces are nothing but rounding
  if (balance_.residual == 0.0 || !loads_.any_acted()) return;
  const double worst = balance_.residual / balance_.scale;
  if (worst <= notable_imbalance) return;
  findings_.warn("rounding",
                 fmt::format("rounding leaves forces out of balance by {:.1e} of the largest one, "
                             "at {:.6g} in {}, above 'Force Tolerance': stiffnesses differ too "
                             "much in size",
                             worst, balance_.time, balance_.row),
                 balance_.time);
}

// Once, and not again what was said of the reference.
void RunObserver::report_turns(double time) {
  if (has_told_turn_) return;
  constexpr double noticeable = 1.05;
  const double told = reference_turn_.share > 1.0 ? noticeable * reference_turn_.share : 1.0;
  if (turn_.share <= told) return;
  if (turn_.is_meaningless()) {
    findings_.broken("turned element", turn_.warning(), time);
  } else {
    findings_.warn("turned element", turn_.warning(), time);
  }
}

void RunObserver::end(model::State& state, const std::string& outcome) {
  progress_.end();
  report_turns(state.time);
  ranges_.report(state.time, findings_);
  waves_.report(findings_);
  shells_.report(state.time, findings_);
  if (!has_history_) start(state);  // also where a run fails before its first step
  // a run that fails leaves its last accepted state
  if (!is_recorded_) record(state.time, static_cast<int>(steps_.rows.back().back()), state, false);
  const Ledger::Scope scope(ledger_, states_effect_);
  std::vector<output::NamedScalar> numbers = {
      {"accepted steps", "", static_cast<double>(accepted_)},
      {"rejected steps", "", static_cast<double>(rejected_)},
      {"iterations", "", static_cast<double>(iterations_)},
      {"worst force residual", "", worst_residual_},
      {"worst constraint violation", "", worst_constraint_},
      {"steps held by rounding", "", static_cast<double>(held_)},
      {"final time", "", state.time}};
  if (turn_.share > 0.0) {
    numbers.push_back({"largest turn of an element, of what it is good for", "", turn_.share});
  }
  if (turn_.share > 1.0) {
    numbers.push_back({"largest turn of an element", "rad", turn_.turn});
    numbers.push_back({"error of its strain energy, estimate", "", turn_.errors().energy});
  }
  numbers.insert(numbers.end(), numbers_.begin(), numbers_.end());
  files_.finish(outcome + "\n\n" + findings() + certificates_ + convergence() + ledger_.report(),
                numbers, {effects_table(ledger_), steps_}, findings_.all());
}

std::string RunObserver::findings() const {
  std::string text;
  for (const Finding& finding : findings_.all()) {
    const bool is_broken = finding.grade == Finding::Grade::broken;
    text += fmt::format("{}: {} ({}{}at {:.6g}): {}\n", is_broken ? "BROKEN" : "warning",
                        finding.kind, finding.analysis, finding.analysis.empty() ? "" : ", ",
                        finding.time, finding.text);
  }
  return text.empty() ? text : text + "\n";
}

std::string RunObserver::convergence() const {
  const std::string held =
      held_ == 0 ? std::string()
                 : fmt::format(
                       "in {} of the steps rounding holds forces above 'Force Tolerance', "
                       "most at {}: {:.1e}\n",
                       held_, worst_held_row_, worst_held_);
  std::string linear;
  if (linear_solver_ != nullptr) {
    const std::string remark = linear_solver_->solver->remark();
    linear = linear_solver_->reason + (remark.empty() ? "" : "; " + remark);
  }
  return fmt::format(
      "{} steps accepted, {} cut back; {} iterations, {:.1f} per step, at most {}\n"
      "worst accepted residual: forces {:.1e}, constraints {:.1e}\n"
      "{}"
      "linear solver: {}\n{}",
      accepted_, rejected_, iterations_,
      accepted_ > 0 ? static_cast<double>(iterations_) / accepted_ : 0.0, most_iterations_,
      worst_residual_, worst_constraint_, held, linear, air_);
}

std::string RunObserver::closing_words() const {
  return "\n" + ledger_.report() + "\n" + certificates_ + convergence() +
         "results:" + files_.listing();
}

}  // namespace culm::simulation
