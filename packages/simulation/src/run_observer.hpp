/// Sees every step of a run: results, progress, statistics.
#pragma once

#include <culm/analysis/element_turns.hpp>
#include <culm/analysis/stepper.hpp>
#include <culm/simulation/progress.hpp>
#include <culm/simulation/read_deck.hpp>
#include <culm/simulation/result_files.hpp>
#include <culm/solver/linear_solver.hpp>

#include "bent_shells.hpp"
#include "checkpoints.hpp"
#include "earlier_states.hpp"
#include "imperfections.hpp"
#include "load_watch.hpp"
#include "range_watch.hpp"
#include "strip_watch.hpp"
#include "wave_watch.hpp"

#include <optional>

namespace culm::simulation {

class CoupledRun;
class ServedRun;

/// The outcome of a run that a program led and left before its end.
inline constexpr const char* ended_from_outside = "ended by the program that made the steps";

/// How well the steps of an analysis are in balance, beside the largest force of any of them: the
/// first steps may be all but unloaded.
struct Balance {
  double scale = 0.0;     ///< largest force of any item [N, N m]
  double residual = 0.0;  ///< the largest that rounding held above the tolerance [N, N m]
  double time = 0.0;      ///< when that was
  std::string row;        ///< where that was
};

class RunObserver final : public analysis::Observer {
 public:
  /// Version of what a checkpoint holds.
  static constexpr int checkpoint_format = 12;

  /// @param checkpoints  null: there are none, and nobody stops the run
  RunObserver(Ledger& ledger, Findings& findings, ResultFiles& files, Checkpoints* checkpoints,
              const DeckSource& source, const EarlierStates& earlier,
              const Imperfections& imperfections, const analysis::ElementTurn& reference_turn,
              Progress progress);

  /// Records the state in which the first analysis begins, whatever it does; in the history only
  /// where no analysis of the deck makes steps.
  void start_run(model::State& state, bool steps_follow);
  /// Adds the state from which an analysis makes steps to the history, and records the first one.
  void start(model::State& state) override;
  /// Records a state that is not the last one, for what looks at it.
  void record_start(const model::State& state) { record(state.time, 0, state, false); }
  /// Goes on from a checkpoint instead.
  void restore(const Snapshot& snapshot);
  /// @param number   of the analysis in the deck, from 0
  /// @param is_last  of the deck
  /// @param linear_solver for the report; it lives as long as the run
  void begin(const Options& entry, std::size_t number, bool is_last, analysis::Context& context,
             const solver::ChosenSolver& linear_solver);
  /// The end of the present analysis is a checkpoint, from which the run can go on to a later one.
  void keep_end() { keeps_end_ = true; }
  /// What makes the steps from now on, and what its checkpoints hold; none: nothing does.
  /// @param coupled, served  what else they hold; null if nothing does. A run that is led writes
  /// checkpoints when it is asked to.
  void follow(analysis::Stepper* stepper, CoupledRun* coupled, ServedRun* served) {
    stepper_ = stepper;
    coupled_ = coupled;
    served_ = served;
    shows_each_step_ = coupled != nullptr || served != nullptr;
  }
  /// Rows of the history are in their file after each step, because a program that makes the steps
  /// may wait between them and read it. So it is beside partners anyway.
  void show_each_step() { shows_each_step_ = true; }
  /// Goes on within an analysis that has begun before.
  void resume(const Snapshot& snapshot);
  /// Throws Stopped, on all ranks after the same step, when the run has to end.
  void step(const analysis::StepReport& report, model::State& state) override;
  void pass(const analysis::StepReport& report) override;
  void keep(Snapshot& snapshot) const override;
  /// Also in the files. But findings stay.
  void go_back(const Snapshot& kept) override;
  /// Writes a checkpoint of the present analysis, if it has made a step and the deck wants any.
  /// @return whether it did
  bool write_checkpoint();
  /// The numbers of the last row of the history.
  const std::vector<double>& shown() const { return shown_; }
  /// How to go on from the last checkpoint, in a line that begins anew; empty if there is none.
  std::string way_on() const;
  /// Whether step() stopped the run, with words on how to go on.
  bool has_said_farewell() const { return has_said_farewell_; }
  void finish(const analysis::AnalysisReport& report, const model::State& state) override;
  /// Closes the files with a report of how the run ended.
  void end(model::State& state, const std::string& outcome);
  /// Results, ledger and convergence of the run, for the user.
  std::string closing_words() const;

 private:
  void save(Snapshot& snapshot) const;
  std::string convergence() const;
  std::string free_prefix() const;
  void add_held(const analysis::StepReport& report);
  std::string findings() const;
  /// Says where rounding held a step further out of balance than the deck allows.
  void report_rounding();
  void watch_loads(const analysis::StepReport& report, model::State& state);
  void watch_turns(double time, const model::State& state);
  void report_turns(double time);
  void add_history(double time, int step, model::State& state);
  void record(double time, int step, const model::State& state, bool was_solved);
  void record_early_end(const model::State& state);

  Ledger& ledger_;
  Findings& findings_;
  ResultFiles& files_;
  Checkpoints* checkpoints_;
  const DeckSource& source_;
  const EarlierStates& earlier_;
  const Imperfections& imperfections_;
  const analysis::ElementTurn& reference_turn_;          // the largest one before any load
  analysis::ElementTurn turn_;                           // the largest one so far
  const solver::ChosenSolver* linear_solver_ = nullptr;  // of the analysis
  Progress progress_;
  Ledger::Id quantities_effect_;
  Ledger::Id history_effect_;
  Ledger::Id states_effect_;
  Ledger::Id checkpoint_effect_ = 0;
  analysis::Stepper* stepper_ = nullptr;
  CoupledRun* coupled_ = nullptr;
  ServedRun* served_ = nullptr;
  bool shows_each_step_ = false;
  analysis::Context* context_ = nullptr;  // of the analysis
  std::string name_;                      // of the analysis
  std::size_t number_ = 0;
  bool is_last_ = false;
  bool keeps_end_ = false;
  std::optional<double> kept_;  // time of the last checkpoint [s]
  bool has_stepped_ = false;    // the analysis has something to save
  bool is_recorded_ = false;    // the last accepted state is on disk, or none to keep
  bool has_started_ = false;    // the state at the start is on disk
  bool has_history_ = false;    // the history has a row
  LoadWatch loads_;
  RangeWatch ranges_;
  WaveWatch waves_;
  StripWatch strips_;
  BentShells shells_;
  Balance balance_;
  std::string certificates_;
  std::optional<analysis::ElementTurns> turns_;  // of the analysis
  bool has_said_farewell_ = false;
  bool has_told_turn_ = false;  // that an element is turned so far that results mean nothing
  std::vector<output::NamedScalar> numbers_;
  // the accepted steps, for the report; analyses by number in the deck
  output::NamedTable steps_{
      "steps",
      {"time", "iterations", "force residual", "held by rounding", "analysis", "step"},
      {},
      {}};
  std::vector<double> shown_;
  int accepted_ = 0;
  int passed_ = 0;  // of them since the last one that was shown
  int rejected_ = 0;
  int iterations_ = 0;
  int most_iterations_ = 0;
  std::string air_;  // what it did in the last analysis
  double worst_residual_ = 0.0;
  double worst_constraint_ = 0.0;
  int held_ = 0;                // accepted steps that rounding holds above the force tolerance
  double worst_held_ = 0.0;     // largest residual of them
  std::string worst_held_row_;  // where it is
};

}  // namespace culm::simulation
