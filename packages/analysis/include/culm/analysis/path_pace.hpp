/// How fast a path comes nearer to where it shall end.
#pragma once

#include <culm/base/snapshot.hpp>

#include <optional>
#include <vector>

namespace culm::analysis {

/// Remembers the last points of a path, by load level and watched displacement.
class PathPace {
 public:
  static constexpr int steps = 10;  ///< whose pace it is

  /// The start, then the end of each step.
  void add(double level, double watched);
  /// Steps that are left to a level at the pace of the last ones; infinite where these came no
  /// nearer, nothing before there are enough of them.
  std::optional<double> steps_to_level(double target) const { return steps_to(levels_, target); }
  /// The same to a watched displacement [m].
  std::optional<double> steps_to_displacement(double target) const {
    return steps_to(watched_, target);
  }

  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

 private:
  static std::optional<double> steps_to(const std::vector<double>& points, double target);

  std::vector<double> levels_, watched_;  ///< at most one more than `steps`
};

}  // namespace culm::analysis
