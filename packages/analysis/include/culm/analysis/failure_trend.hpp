/// Tells an increment that finds its way from one that collapses.
#pragma once

#include <culm/base/snapshot.hpp>

#include <optional>
#include <vector>

namespace culm::analysis {

/// Remembers the levels at which load steps failed. Before a limit point each failure follows the
/// one before it sooner: what is gained between them shrinks like a geometric series, whose sum is
/// a level that load control cannot pass; the faster they shrink, the fewer of them tell. A
/// structure that recovers gains more again.
class FailureTrend {
 public:
  /// A step from this level failed; several from the same level count once.
  void add(double level);
  /// The level to which the gains sum up, once they collapse short of the final one.
  std::optional<double> end(double final_level) const;

  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

 private:
  std::vector<double> levels_;  ///< the last ones, rising
};

}  // namespace culm::analysis
