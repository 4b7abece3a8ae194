#include "run_observer.hpp"

#include <culm/analysis/unknown_names.hpp>
#include <culm/base/error.hpp>
#include <culm/base/version.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace culm::simulation {
namespace {

// The ledger as numbers; what makes no sense for an effect is not a number.
output::NamedTable effects_table(const Ledger& ledger) {
  output::NamedTable table{
      "effects", {"items", "unknowns", "entries per iteration", "calls", "time [s]"}, {}, {}};
  const auto number = [](const std::optional<long long>& count) {
    return count ? static_cast<double>(*count) : std::numeric_limits<double>::quiet_NaN();
  };
  for (const Ledger::Entry& e : ledger.entries()) {
    table.rows.push_back({number(e.items), number(e.unknowns), number(e.entries_per_iteration),
                          static_cast<double>(e.calls), e.seconds});
    table.remarks.push_back(e.name);
  }
  return table;
}

}  // namespace

RunObserver::RunObserver(Ledger& ledger, ResultFiles& files, Checkpoints& checkpoints,
                         const DeckSource& source, const EarlierStates& earlier,
                         const Imperfections& imperfections, Progress progress)
    : ledger_(ledger),
      files_(files),
      checkpoints_(checkpoints),
      source_(source),
      earlier_(earlier),
      imperfections_(imperfections),
      progress_(std::move(progress)),
      quantities_effect_(ledger.add("Quantities")),
      history_effect_(ledger.add("Output, history")),
      states_effect_(ledger.add("Output, states")) {
  if (checkpoints_.are_active()) checkpoint_effect_ = ledger.add("Checkpoints");
}

void RunObserver::begin(const std::string& name, std::size_t number, bool is_last,
                        const analysis::Analysis& analysis, analysis::Context& context,
                        const std::string& linear_solver) {
  progress_.begin(name);
  context_ = &context;
  linear_solver_ = linear_solver;
  name_ = name;
  analysis_ = &analysis;
  number_ = number;
  is_last_ = is_last;
  has_stepped_ = false;
}

void RunObserver::start(model::State& state) {
  add_history(state.time, state);
  record(state.time, state);
}

void RunObserver::add_history(double time, model::State& state) {
  std::vector<double> numbers;
  {
    const Ledger::Scope scope(ledger_, quantities_effect_);
    numbers = files_.evaluate(state);
  }
  const Ledger::Scope scope(ledger_, history_effect_);
  files_.add_history(time, numbers);
}

void RunObserver::record(double time, model::State& state) {
  const Ledger::Scope scope(ledger_, states_effect_);
  files_.record(time, state);
}

void RunObserver::step(const analysis::StepReport& report, model::State& state) {
  const auto& outcome = report.outcome;
  has_stepped_ = true;
  iterations_ += outcome.iterations;
  if (report.accepted) {
    ++accepted_;
    most_iterations_ = std::max(most_iterations_, outcome.iterations);
    worst_residual_ = std::max(worst_residual_, outcome.history.back().force);
    worst_constraint_ = std::max(worst_constraint_, outcome.history.back().constraint);
    steps_.rows.push_back({report.time, static_cast<double>(outcome.iterations),
                           outcome.history.back().force, outcome.held_unknown ? 1.0 : 0.0});
    if (outcome.held_unknown) add_held(outcome);
    add_history(report.time, state);
    is_recorded_ = files_.is_due(accepted_) || report.is_last;
    if (is_recorded_) record(report.time, state);
  } else {
    ++rejected_;
  }
  progress_.show(report);
  const Checkpoints::Demand demand = checkpoints_.demand();
  const bool ends = is_last_ && report.is_last;
  if (demand == Checkpoints::Demand::none && !ends) return;
  write_checkpoint(state);
  if (demand == Checkpoints::Demand::stop) throw Stopped(checkpoints_.farewell());
}

void RunObserver::add_held(const solver::StepOutcome& outcome) {
  ++held_;
  if (outcome.history.back().force <= worst_held_) return;
  worst_held_ = outcome.history.back().force;
  worst_held_row_ = analysis::UnknownNames(context_->system).name_of(*outcome.held_unknown);
}

void RunObserver::write_checkpoint(model::State& state) {
  if (!checkpoints_.are_active() || !has_stepped_) return;
  const Ledger::Scope scope(ledger_, checkpoint_effect_);
  Snapshot snapshot;
  save(snapshot);
  context_->system.save(state, snapshot);
  analysis_->save(*context_, snapshot);
  files_.save(snapshot);
  checkpoints_.write(snapshot);
}

void RunObserver::save(Snapshot& snapshot) const {
  snapshot.set("format", checkpoint_format);
  snapshot.set_text("run/version", std::string(version));
  snapshot.set("run/ranks", context_->system.comm().size());
  snapshot.set("run/analysis", static_cast<double>(number_));
  source_.save(snapshot);
  earlier_.save(snapshot);
  imperfections_.save(snapshot);
  snapshot.set(
      "run/counts",
      {static_cast<double>(accepted_), static_cast<double>(rejected_),
       static_cast<double>(iterations_), static_cast<double>(most_iterations_), worst_residual_,
       worst_constraint_, is_recorded_ ? 1.0 : 0.0, static_cast<double>(held_), worst_held_});
  snapshot.set_text("run/held row", worst_held_row_);
  snapshot.set_text("run/certificates", certificates_);
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

void RunObserver::restore(const Snapshot& snapshot) {
  const std::vector<double>& counts = snapshot.numbers("run/counts", 9);
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
  const std::vector<double>& steps = snapshot.numbers("run/steps");
  const std::size_t columns = steps_.columns.size();
  for (std::size_t i = 0; i + columns <= steps.size(); i += columns) {
    const auto row = steps.begin() + static_cast<std::ptrdiff_t>(i);
    steps_.rows.emplace_back(row, row + static_cast<std::ptrdiff_t>(columns));
  }
  const std::vector<double>& values = snapshot.numbers("run/numbers");
  for (std::size_t i = 0; i < values.size(); ++i) {
    numbers_.push_back({snapshot.text("run/number " + std::to_string(i)), "", values[i]});
  }
}

void RunObserver::finish_analysis(const analysis::AnalysisReport& report,
                                  const model::State& state) {
  {
    const Ledger::Scope scope(ledger_, states_effect_);
    files_.add_results(name_, report, state);
  }
  certificates_ += report.text;
  const bool is_first = numbers_.empty();
  for (const auto& [name, value] : report.numbers) {
    numbers_.push_back({is_first ? name : name_ + ": " + name, "", value});
  }
}

void RunObserver::end(model::State& state, const std::string& outcome) {
  progress_.end();
  const Ledger::Scope scope(ledger_, states_effect_);
  // a run that fails leaves its last accepted state
  if (!is_recorded_) files_.record(state.time, state);
  std::vector<output::NamedScalar> numbers = {
      {"accepted steps", "", static_cast<double>(accepted_)},
      {"rejected steps", "", static_cast<double>(rejected_)},
      {"iterations", "", static_cast<double>(iterations_)},
      {"worst force residual", "", worst_residual_},
      {"worst constraint violation", "", worst_constraint_},
      {"steps held by rounding", "", static_cast<double>(held_)},
      {"final time", "", state.time}};
  numbers.insert(numbers.end(), numbers_.begin(), numbers_.end());
  files_.finish(outcome + "\n\n" + certificates_ + convergence() + ledger_.report(), numbers,
                {effects_table(ledger_), steps_});
}

std::string RunObserver::convergence() const {
  const std::string held =
      held_ == 0 ? std::string()
                 : fmt::format(
                       "in {} of the steps rounding holds forces above 'Force Tolerance', "
                       "most at {}: {:.1e}\n",
                       held_, worst_held_row_, worst_held_);
  return fmt::format(
      "{} steps accepted, {} cut back; {} iterations, {:.1f} per step, at most {}\n"
      "worst accepted residual: forces {:.1e}, constraints {:.1e}\n"
      "{}"
      "linear solver: {}\n",
      accepted_, rejected_, iterations_,
      accepted_ > 0 ? static_cast<double>(iterations_) / accepted_ : 0.0, most_iterations_,
      worst_residual_, worst_constraint_, held, linear_solver_);
}

std::string RunObserver::closing_words() const {
  std::string text = "\n" + ledger_.report() + "\n" + certificates_ + convergence() + "results:";
  for (const auto& path : files_.paths()) text += "\n  " + path.string();
  return text;
}

}  // namespace culm::simulation
