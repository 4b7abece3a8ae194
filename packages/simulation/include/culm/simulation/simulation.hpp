/// A deck as a running model.
#pragma once

#include <culm/base/ledger.hpp>
#include <culm/base/log.hpp>
#include <culm/base/options.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/simulation/catalogue.hpp>
#include <culm/simulation/memory.hpp>
#include <culm/simulation/read_deck.hpp>
#include <culm/simulation/stop_request.hpp>

#include <filesystem>
#include <memory>
#include <string>

namespace culm::simulation {

struct Phase;
class ResultFiles;
class RunObserver;

/// How a run talks and where it writes.
struct RunSettings {
  std::filesystem::path folder;  ///< for results
  bool quiet = false;
  bool terminal = false;  ///< standard output is a terminal
  bool strict = false;    ///< warnings count as broken promises
};

/// Builds the model of a deck and runs its analyses. The same on all ranks.
class Simulation {
 public:
  /// Builds the model. Throws InputError with all mistakes.
  /// @param deck validated with Catalogue::deck_schema
  /// @param source what it was read from, for checkpoints
  /// @param memory what the model may need [B]
  Simulation(const parallel::Comm& comm, const Catalogue& catalogue, const Options& deck,
             DeckSource source, const Log& log, double memory = machine_memory());
  ~Simulation();

  /// Runs all analyses and writes results. On NumericalError or NonFiniteError the files hold
  /// everything up to the last accepted step, and the post-mortem as report. Throws Stopped when a
  /// signal or the end of the time allowed stopped the run, and PromiseBroken when it came to its
  /// end but not all that culm promises holds. Throws FileError with nothing changed if another
  /// process writes into the folder, if an input of the deck would be overwritten, or if the
  /// checkpoint belongs to another model or to other results.
  /// @param from  checkpoint of an earlier run in this folder, to go on with
  void run(const RunSettings& settings, const StopRequest& request, const Snapshot* from = nullptr);

  /// Structures, masses, unknowns and effects, for `culm check`.
  std::string summary() const;

  /// Does what analyses that start from the reference do before their first step, and throws what
  /// run() would throw there: NumericalError of a mechanism. With a note instead where a
  /// factorisation is long work.
  void examine();

 private:
  void run_analyses(model::State& state, RunObserver& observer, ResultFiles& files,
                    const Snapshot* from);
  void start_analysis(std::size_t number, model::State& state);
  Snapshot read_state(const Options& analysis, Phase& phase, model::State& state);
  void keep_state(const std::string& name, model::State& state);
  void write_last_checkpoint(model::State& state, RunObserver& observer) const;

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace culm::simulation
