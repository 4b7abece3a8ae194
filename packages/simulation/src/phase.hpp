/// What the analyses of a deck work on.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/simulation/catalogue.hpp>
#include <culm/simulation/result_files.hpp>

#include <deque>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace culm::simulation {

/// Loads and constraints that do not act, by name.
using Inactive = std::set<std::string>;

/// The model of analyses in which the same loads and constraints act.
struct Phase {
  Inactive inactive;
  model::Model model;
  std::vector<WatchedQuantity> watched;
  std::unique_ptr<assembly::System> system;  ///< made when it is first needed
  solver::ChosenSolver linear;
};

/// The phases of a deck. Nodes are the same in all of them; unknowns, equations and batches are
/// not.
class Phases {
 public:
  /// Builds all models. Throws InputError with all mistakes of the first one that has any.
  Phases(const Catalogue& catalogue, const Options& deck, const Log& log);

  /// The phase of an analysis, ready to work on; collective.
  Phase& enter(std::size_t analysis, const parallel::Comm& comm, Ledger& ledger);
  const Phase& of(std::size_t analysis) const { return *by_analysis_[analysis]; }

 private:
  Phase& find_or_build(const Catalogue& catalogue, const Options& deck, const Log& log,
                       const Inactive& inactive);
  void complete_columns(const Options& history);

  std::string linear_solver_;
  std::deque<Phase> phases_;
  std::vector<Phase*> by_analysis_;
};

/// A state of one phase as another one understands it: nodes as they are, multipliers by the names
/// of their constraints, memories of batches by their effects; what is new begins at zero.
/// @param saved by System::save in phase `from`
Snapshot hand_over(const Snapshot& saved, const Phase& from, const Phase& to);

}  // namespace culm::simulation
