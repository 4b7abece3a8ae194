/// Frequencies over the load level: of a rotor over its speed.
#pragma once

#include <culm/analysis/find_modes.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

#include <vector>

namespace culm::analysis {

/// Where and which modes.
struct CampbellSettings {
  std::vector<double> levels;  ///< rising
  ModalSettings modes;
  solver::NewtonSettings newton;
};

/// Static equilibrium and modes at each of some load levels, from the present state on. Modes are
/// followed from level to level by their shapes. With a rotating frame whose speed grows with the
/// level this is the Campbell diagram. The state ends at the last level.
class Campbell final : public Analysis {
 public:
  explicit Campbell(CampbellSettings settings) : settings_(std::move(settings)) {}

  static Schema schema();
  static std::unique_ptr<Analysis> make(const Options& options);

  void save(const Context&, Snapshot&) const override {}  // it is one step to others

 private:
  void start(Context&, model::State&) override {}
  void restore(Context&, const Snapshot&) override {}
  AnalysisReport advance(Context& context, model::State& state, Observer& observer) override;

  CampbellSettings settings_;
};

}  // namespace culm::analysis
