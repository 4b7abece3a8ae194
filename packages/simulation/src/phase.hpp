/// What the analyses of a deck work on.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/model/size_budget.hpp>
#include <culm/port/register_port.hpp>
#include <culm/simulation/catalogue.hpp>
#include <culm/simulation/result_files.hpp>

#include "imperfections.hpp"
#include "sampled_signals.hpp"

#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace culm::simulation {

/// Loads, constraints and imperfections that do not act, by name.
using Inactive = std::set<std::string>;

/// What an analysis wants of its model.
struct Setting {
  Inactive inactive;
  bool is_path = false;  ///< 'Ramp' goes on below level 0 and above level 1

  bool operator==(const Setting&) const = default;
};

/// The model of analyses in which the same loads, constraints and imperfections act.
struct Phase {
  Setting setting;
  std::set<std::string> bent_by;  ///< imperfections that analyses of this run find
  std::unique_ptr<model::Model> model;
  std::vector<WatchedQuantity> watched;
  std::vector<SampledSignal> samples;  ///< from what is watched
  std::vector<std::unique_ptr<port::Port>> ports;
  std::unique_ptr<assembly::System> system;  ///< made when it is first needed
  solver::ChosenSolver linear;
  model::MemoryNeed need;  ///< predicted from the deck
  Snapshot reference;      ///< its state at the beginning, if anything starts from there
};

/// What the factors need on a machine by the graph, not by the sides of meshes [B]. Collective.
/// @pre the system is made
double factors_by_graph(const Phase& phase, const parallel::Comm& comm, model::Processes processes);

/// The phases of a deck. Nodes are the same in all of them; unknowns, equations and batches are
/// not, nor is the stress-free geometry once an analysis has found an imperfection of it.
class Phases {
 public:
  /// Builds all models. Throws InputError with all mistakes of the first one that has any, and
  /// where an analysis would go on with another stress-free geometry.
  /// @param imperfections  those of the deck; both are referred to
  /// @param memory  that each model may need on a machine [B]
  /// @param processes  that share it
  Phases(const Catalogue& catalogue, const Options& deck, const Imperfections& imperfections,
         const Log& log, double memory, model::Processes processes);

  /// The phase of an analysis, ready to work on; collective. What bends its geometry has been
  /// found.
  Phase& enter(std::size_t analysis, const parallel::Comm& comm, Ledger& ledger);
  const Phase& of(std::size_t analysis) const { return *by_analysis_[analysis]; }
  /// Whether an analysis goes on from a path and is none.
  bool leaves_path(std::size_t analysis) const;
  /// Of analyses that follow each other as in the deck: throws InputErrors if a motion
  /// would begin behind its end.
  void refuse_late_starts() const;
  /// Adds a port to all models, beside those of the deck; before any analysis begins. Throws
  /// UsageError where a point has no place.
  void add_port(const std::string& name, port::Cloud cloud);

 private:
  Phase& find_or_build(const Setting& setting);
  void build(Phase& phase) const;
  static void attach(const std::string& name, const port::Cloud& cloud, Phase& phase);
  void refuse_jumps() const;
  std::optional<double> end_of(std::size_t analysis) const;
  void complete_columns();

  const Catalogue& catalogue_;
  const Options& deck_;
  const Imperfections& imperfections_;
  const Log& log_;
  double memory_;               ///< that each model may need on a machine [B]
  model::Processes processes_;  ///< that share it
  std::vector<std::pair<std::string, port::Cloud>> clouds_;  ///< of ports that a program added
  std::deque<Phase> phases_;
  std::vector<Phase*> by_analysis_;
};

/// Loads of ports go on in the next phase.
void hand_over_loads(const Phase& from, Phase& to);

/// A state of one phase as another one understands it: nodes as they are, multipliers by the names
/// of their constraints, memories of batches by their effects; what is new begins as in the
/// reference, so that a torsion spring counts its angle from there.
/// @param saved by System::save in phase `from`
Snapshot hand_over(const Snapshot& saved, const Phase& from, const Phase& to);

}  // namespace culm::simulation
