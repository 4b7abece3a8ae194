#include "run_observer.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace culm::simulation {

void RunObserver::start(model::State& state) {
  const Ledger::Scope scope(ledger_, output_effect_);
  files_.add_history(state.time, state);
  files_.record(state.time, state);
}

void RunObserver::step(const analysis::StepReport& report, model::State& state) {
  const auto& outcome = report.outcome;
  iterations_ += outcome.iterations;
  if (report.accepted) {
    ++accepted_;
    most_iterations_ = std::max(most_iterations_, outcome.iterations);
    worst_residual_ = std::max(worst_residual_, outcome.history.back().force);
    worst_constraint_ = std::max(worst_constraint_, outcome.history.back().constraint);
    const Ledger::Scope scope(ledger_, output_effect_);
    files_.add_history(report.time, state);
    is_recorded_ = files_.is_due(accepted_) || report.time >= report.final_time;
    if (is_recorded_) files_.record(report.time, state);
  } else {
    ++rejected_;
  }
  progress_.show(report);
}

void RunObserver::finish_analysis(const analysis::AnalysisReport& report) {
  certificates_ += report.text;
  for (const auto& [name, value] : report.numbers) numbers_.push_back({name, "", value});
}

void RunObserver::end(model::State& state, const std::string& outcome) {
  progress_.end();
  const Ledger::Scope scope(ledger_, output_effect_);
  // a run that fails leaves its last accepted state
  if (!is_recorded_) files_.record(state.time, state);
  std::vector<output::NamedScalar> numbers = {
      {"accepted steps", "", static_cast<double>(accepted_)},
      {"rejected steps", "", static_cast<double>(rejected_)},
      {"iterations", "", static_cast<double>(iterations_)},
      {"worst force residual", "", worst_residual_},
      {"worst constraint violation", "", worst_constraint_},
      {"final time", "", state.time}};
  numbers.insert(numbers.end(), numbers_.begin(), numbers_.end());
  files_.finish(outcome + "\n\n" + certificates_ + convergence() + ledger_.report(), numbers);
}

std::string RunObserver::convergence() const {
  return fmt::format(
      "{} steps accepted, {} cut back; {} iterations, {:.1f} per step, at most {}\n"
      "worst accepted residual: forces {:.1e}, constraints {:.1e}\n"
      "linear solver: {}\n",
      accepted_, rejected_, iterations_,
      accepted_ > 0 ? static_cast<double>(iterations_) / accepted_ : 0.0, most_iterations_,
      worst_residual_, worst_constraint_, linear_solver_);
}

std::string RunObserver::closing_words() const {
  std::string text = "\n" + ledger_.report() + "\n" + certificates_ + convergence() + "results:";
  for (const auto& path : files_.paths()) text += "\n  " + path.string();
  return text;
}

}  // namespace culm::simulation
