/// What a simulation is made of.
#pragma once

#include <culm/analysis/element_turns.hpp>
#include <culm/analysis/stepper.hpp>
#include <culm/output/folder_lock.hpp>
#include <culm/simulation/simulation.hpp>

#include "coupled_run.hpp"
#include "earlier_states.hpp"
#include "imperfections.hpp"
#include "memories.hpp"
#include "phase.hpp"
#include "run_observer.hpp"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace culm::simulation {

/// What a simulation writes while steps are made.
struct Simulation::Results {
  Results(Parts& p, const RunSettings& settings, const ResultSettings& wanted,
          std::unique_ptr<output::FolderLock> taken, Checkpoints* checkpoints,
          const Snapshot* from);

  std::unique_ptr<output::FolderLock> lock;
  ResultFiles files;
  RunObserver observer;
};

struct Simulation::Parts {
  parallel::Comm comm;
  std::shared_ptr<const Catalogue> held;  ///< the catalogue, where nobody else keeps it
  const Catalogue& catalogue;
  Options deck;
  DeckSource source;
  Log log;
  double memory;  ///< of a machine, the same on all ranks [B]
  model::Processes processes = {comm.size(), comm.most_on_a_machine()};
  Ledger ledger = {};  ///< before the phases, whose systems give it the rest when they end
  Findings findings = Findings(log);
  Imperfections imperfections = Imperfections(deck, catalogue.analyses.gives_shapes);
  Phases phases = Phases(catalogue, deck, imperfections, log, memory, processes);
  EarlierStates earlier = EarlierStates(deck.list("Analyses"));
  std::size_t present = 0;                  ///< the analysis whose phase the state belongs to
  std::vector<double> first_memories = {};  ///< of what is watched, before any state
  std::vector<double> other_memories = {};  ///< from the run that the present analysis starts from
  analysis::ElementTurn reference_turn =
      {};  ///< the largest one without load; its share tells if any

  // driven from outside, see begin()
  model::State state = {};
  std::optional<analysis::Context> context = {};
  std::unique_ptr<Results> results = {};    ///< if any are wanted
  std::optional<MemoryKeeper> keeper = {};  ///< if none are
  std::unique_ptr<analysis::Stepper> stepper = {};
  long taken_up = 0;                                          ///< analyses so far
  std::map<std::string, std::vector<double>> set_loads = {};  ///< as they were set last
  std::set<model::Effect> heard = {};  ///< loads from outside that have acted in this analysis

  void warn_of_reference();
  void tell_of(const port::Port& port);
  /// Of where an analysis ends, in its phase; collective. @param q  up to date
  void warn_of_end(const model::Coordinates& q, double time);
  /// What is watched remembers this where an analysis with 'Start From' begins.
  std::span<const double> memories_at(const Options& analysis) const;
  /// Hands what is watched over to the phase of the present analysis. @param begins  or goes on
  void let_watch(ResultFiles& files, const Options& analysis, bool begins);
  /// The same where no results are written. @param before  the phase of the analysis before
  void let_remember(const Phase& before, const Options& analysis);
  /// After a load was set that is not zero: says once if supports take all of it.
  void hear(const model::Effect& effect);
  /// With its partners; null if the deck has none. @param files  for a run
  std::unique_ptr<CoupledRun> make_coupling(const CoupledFiles& files);
};

}  // namespace culm::simulation
