/// Finds loads that leave the range of their methods.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/model/method_limits.hpp>

#include <vector>

namespace culm::simulation {

/// Looks at the loads of an analysis that say a limit of their method, after each accepted step.
class RangeWatch {
 public:
  /// Starts anew with the loads of a model, which must outlive this.
  void begin(const model::Model& model);
  /// After an accepted step. Collective; costs nothing without such loads.
  void step(const assembly::System& system);
  /// Adds a finding for each load that went beyond its range.
  void report(double time, Findings& findings) const;

  /// As "run/ranges".
  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

 private:
  struct Load {
    const model::LimitedRange* method = nullptr;
    double used = 0.0;
  };

  std::vector<Load> loads_;
};

}  // namespace culm::simulation
