/// Finds loads that do nothing: that supports take as a whole, or that are zero all the time.
#pragma once

#include <culm/analysis/analysis.hpp>

#include <map>
#include <string>
#include <vector>

namespace culm::simulation {

/// Whether a load acts by given forces. Springs, dampers and what turns act by laws of their own,
/// and may well act on held nodes.
bool is_given(const model::Batch& load);

/// Whether supports take all of a load.
bool goes_into_supports(const assembly::LoadShare& share);
/// What to say of such a load.
std::string idle_warning(const model::Batch& load);

/// Looks at the dead and follower loads of an analysis, at temperatures, and at loads of ports,
/// until each has moved something. A load that never did although it acted went straight into the
/// supports.
class LoadWatch {
 public:
  /// Starts anew with the loads of a model, which must outlive this.
  void begin(const model::Model& model);
  /// After an accepted step. Collective; costs nothing once all loads have moved something.
  /// @param theta     point of the step where loads act
  /// @param rounding  force that rounding left out of balance, to which a partner may answer [N]
  void step(const assembly::System& system, const model::State& state, double theta,
            double rounding);
  /// Whether any of them acted at all.
  bool any_acted() const;
  /// At the end of an analysis: adds a finding for each load that moved nothing; at the end of the
  /// last one, also for those that were zero in all steps of the run.
  void report(const model::State& state, bool is_last, Findings& findings);

  /// As "run/loads", "run/acted", "run/silent".
  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

 private:
  enum class Seen { nothing, held, moving };
  struct Load {
    model::Batch* batch = nullptr;
    Seen seen = Seen::nothing;
  };

  void report_held(const model::State& state, Findings& findings) const;
  void report_silent(double time, Findings& findings) const;

  std::vector<Load> loads_;
  bool is_driven_ = false;             // supports move the model
  bool hangs_ = false;                 // bodies alone, which may move
  bool has_stepped_ = false;           // in this analysis
  std::map<std::string, bool> acted_;  // whether it did in an analysis that is over, by its name
};

}  // namespace culm::simulation
