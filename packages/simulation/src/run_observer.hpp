/// Sees every step of a run: results, progress, statistics.
#pragma once

#include <culm/simulation/progress.hpp>
#include <culm/simulation/result_files.hpp>

namespace culm::simulation {

class RunObserver final : public analysis::Observer {
 public:
  /// @param linear_solver its name and why it was taken, for the report
  RunObserver(assembly::System& system, ResultFiles& files, Ledger& ledger,
              Ledger::Id output_effect, std::string linear_solver, Progress progress)
      : system_(system),
        files_(files),
        ledger_(ledger),
        output_effect_(output_effect),
        linear_solver_(std::move(linear_solver)),
        progress_(std::move(progress)) {}

  /// Records the reference state.
  void start(model::State& state);
  void begin(const std::string& analysis) { progress_.begin(analysis); }
  void step(const analysis::StepReport& report, model::State& state) override;
  void finish_analysis(const analysis::AnalysisReport& report);
  /// Closes the files with a report of how the run ended.
  void end(model::State& state, const std::string& outcome);
  /// Results, ledger and convergence of the run, for the user.
  std::string closing_words() const;

 private:
  std::string convergence() const;

  assembly::System& system_;
  ResultFiles& files_;
  Ledger& ledger_;
  Ledger::Id output_effect_;
  std::string linear_solver_;
  Progress progress_;
  bool is_recorded_ = true;  // the last accepted state is on disk
  std::string certificates_;
  std::vector<output::NamedScalar> numbers_;
  int accepted_ = 0;
  int rejected_ = 0;
  int iterations_ = 0;
  int most_iterations_ = 0;
  double worst_residual_ = 0.0;
  double worst_constraint_ = 0.0;
};

}  // namespace culm::simulation
