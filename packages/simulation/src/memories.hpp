/// What watched quantities remember of the states before, such as turns that were counted.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/assembly/system.hpp>
#include <culm/simulation/quantity.hpp>

#include <optional>
#include <span>
#include <vector>

namespace culm::simulation {

/// Under what snapshots have them.
inline constexpr const char* memories_key = "output/memories";
/// Under what snapshots for memory have the numbers that were shown last.
inline constexpr const char* shown_key = "output/shown";

/// Of all, one after the other.
std::vector<double> memories_of(const std::vector<WatchedQuantity>& watched);
/// Takes them back.
void restore_memories(const std::vector<WatchedQuantity>& watched,
                      std::span<const double> memories);
/// Hands them over from one phase to another one.
void hand_over_memories(const std::vector<WatchedQuantity>& from,
                        const std::vector<WatchedQuantity>& to);

/// Shows each accepted state once to what is watched, where nobody writes results: there are
/// quantities that remember, and what belongs to a step, such as reactions, is known right behind
/// it only.
class MemoryKeeper final : public analysis::Observer {
 public:
  MemoryKeeper(assembly::System& system, const std::vector<WatchedQuantity>& watched)
      : system_(system), watched_(watched), nodes_(nodes_of(watched)) {}

  void start(model::State& state) override;
  void step(const analysis::StepReport& report, model::State& state) override;
  void keep(Snapshot& snapshot) const override;
  void go_back(const Snapshot& kept) override;
  /// The numbers of the last state that was shown.
  const std::vector<double>& shown() const { return shown_; }

 private:
  void show(model::State& state);

  assembly::System& system_;
  const std::vector<WatchedQuantity>& watched_;
  std::optional<std::vector<int>> nodes_;  // that all read; none: they may read everything
  std::vector<double> shown_;
};

/// A state in which nothing has been solved yet, so that there are no reactions, in whatever form
/// they are computed.
model::State unsolved(const model::Model& model, const model::State& state);
/// Whether any of them remembers anything.
bool remember(const std::vector<WatchedQuantity>& watched);

}  // namespace culm::simulation
