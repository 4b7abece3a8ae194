/// What watched quantities remember of the states before, such as turns that were counted.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/assembly/system.hpp>
#include <culm/simulation/quantity.hpp>

#include <span>
#include <vector>

namespace culm::simulation {

/// Under what snapshots have them.
inline constexpr const char* memories_key = "output/memories";

/// Of all, one after the other.
std::vector<double> memories_of(const std::vector<WatchedQuantity>& watched);
/// Takes them back.
void restore_memories(const std::vector<WatchedQuantity>& watched,
                      std::span<const double> memories);
/// Hands them over from one phase to another one.
void hand_over_memories(const std::vector<WatchedQuantity>& from,
                        const std::vector<WatchedQuantity>& to);

/// Shows each accepted state once to the quantities that remember, where nobody writes results.
class MemoryKeeper final : public analysis::Observer {
 public:
  MemoryKeeper(assembly::System& system, const std::vector<WatchedQuantity>& watched)
      : system_(system), watched_(watched) {}

  void start(model::State& state) override { show(state); }
  void step(const analysis::StepReport& report, model::State& state) override;
  void keep(Snapshot& snapshot) const override;
  void go_back(const Snapshot& kept) override;

 private:
  void show(model::State& state) const;

  assembly::System& system_;
  const std::vector<WatchedQuantity>& watched_;
};

}  // namespace culm::simulation
