/// Shells of small displacements that are bent too far for it.
#pragma once

#include <culm/assembly/system.hpp>
#include <culm/base/findings.hpp>
#include <culm/base/snapshot.hpp>

#include <map>
#include <string>
#include <vector>

namespace culm::simulation {

/// Looks at shells of fidelity Linear after each accepted step. An element that is turned by phi
/// against the frame has its strains wrong by 1 - cos phi: that matters beside the strains there
/// are.
class BentShells {
 public:
  /// Starts anew with the shells of a model, which must outlive this; keeps what it found before.
  void begin(const model::Model& model);
  /// After an accepted step. Collective; costs nothing without such shells.
  /// @param analysis  its name in the deck
  void step(const assembly::System& system, const model::State& state, const std::string& analysis);
  /// Adds a finding for each shell that was bent too far in the run.
  void report(double time, Findings& findings) const;

  /// As "run/bent shells".
  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

 private:
  // the step of a shell in which the error was largest beside the strains
  struct Worst {
    double looked_at = 0.0;  // the largest error so far
    double error = 0.0;      // of a strain
    double strain = 0.0;     // the largest one
    double time = 0.0;       // or level
    std::string analysis;

    double share() const { return strain > 0.0 ? error / strain : 0.0; }
  };

  std::vector<const model::Structure*> linear_;
  std::map<std::string, Worst> shells_;
};

}  // namespace culm::simulation
