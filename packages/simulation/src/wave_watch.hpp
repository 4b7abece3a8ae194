/// Finds seas whose waves add up to more than waves can be.
#pragma once

#include <culm/base/findings.hpp>
#include <culm/model/model.hpp>
#include <culm/water/sea.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// Looks at the surface above what stands in a sea, after each accepted step: each wave of
/// a sum may be possible while the sum is not.
class WaveWatch {
 public:
  /// Starts anew with the loads of a model, which must outlive this.
  void begin(const model::Model& model);
  /// After an accepted step. Costs nothing without waves.
  void step(const model::State& state);
  /// Adds a finding for each sea that was too high.
  void report(Findings& findings) const;

  /// As "run/waves".
  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

 private:
  struct Surface {
    const water::Sea* sea = nullptr;
    std::string load;          // the first one that stands in it
    std::vector<Vec3> places;  // of loads, apart
    double farthest = 0.0;     // from still water, signed [m]
    double time = 0.0;         // [s]
  };
  void add(const water::Sea& sea, const model::Effect& effect, const Vec3& place);

  std::vector<Surface> surfaces_;
};

}  // namespace culm::simulation
