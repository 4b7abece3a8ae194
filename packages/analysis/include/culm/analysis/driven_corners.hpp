/// Corners of prescribed motions, where velocities jump.
#pragma once

#include <culm/assembly/system.hpp>

#include <vector>

namespace culm::analysis {

/// Knows when the speed of a prescribed motion jumps. The conserving scheme mirrors velocities
/// about the mean speed of a step, and would go on to do so behind a corner.
class DrivenCorners {
 public:
  /// Of a step, by which sums of steps may miss the time of a corner.
  static constexpr double same_time = 1e-6;

  explicit DrivenCorners(const assembly::System& system);

  /// Whether there is one within the step from state.time_prev to state.time or at its end, by more
  /// than a hundredth of the speeds on both sides. Costs nothing where no function has a corner
  /// there. Collective.
  bool in_step(const model::State& state);
  /// Whether there may be another one within a step, so that speeds where it begins do not last.
  bool are_within(double start, double end) const;

 private:
  bool is_corner(double time, double step, const model::State& state) const;
  void choose(double step, const model::State& state);

  const assembly::System& system_;
  std::vector<std::vector<double>> functions_;  ///< corners of each, before any step
  std::vector<double> corners_;  ///< of those that lead, rising; none where nothing is driven
  std::vector<double> jumps_;    ///< of these; none where no speed is driven
  bool drives_positions_ = false, drives_speeds_ = false;
};

}  // namespace culm::analysis
