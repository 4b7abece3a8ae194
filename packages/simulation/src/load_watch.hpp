/// Finds loads that supports take as a whole.
#pragma once

#include <culm/analysis/analysis.hpp>

#include <vector>

namespace culm::simulation {

/// Whether a load acts by given forces. Springs, dampers and what turns act by laws of their own,
/// and may well act on held nodes.
bool is_given(const model::Batch& load);

/// Looks at the dead and follower loads of an analysis until each has moved something. A load that
/// never did although it acted went straight into the supports.
class LoadWatch {
 public:
  /// Starts anew with the loads of a model, which must outlive this.
  void begin(const model::Model& model);
  /// After an accepted step. Collective; costs nothing once all loads have moved something.
  void step(const assembly::System& system, const model::State& state);
  /// Whether any of them acted at all.
  bool any_acted() const;
  /// Adds a finding for each load that moved nothing.
  void report(const model::State& state, Findings& findings) const;

  /// As "run/loads".
  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

 private:
  enum class Seen { nothing, held, moving };
  struct Load {
    model::Batch* batch = nullptr;
    Seen seen = Seen::nothing;
  };

  std::vector<Load> loads_;
};

}  // namespace culm::simulation
