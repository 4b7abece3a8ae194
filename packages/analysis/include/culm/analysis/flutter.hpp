/// Where motions begin to grow: flutter and divergence.
#pragma once

#include <culm/analysis/campbell.hpp>

namespace culm::analysis {

/// Static equilibrium and damped modes at each of some load levels, from the present state on, as
/// in Campbell; then the first level at which an oscillation begins to grow (flutter), and the
/// first one at which a motion without oscillation does (divergence), each to 1e-6. Flows and loads
/// grow with the level by their functions. The state ends at the last level.
class Flutter final : public Inspection {
 public:
  explicit Flutter(CampbellSettings settings) : settings_(std::move(settings)) {}

  static Schema schema();
  static std::unique_ptr<Inspection> make(const Options& options);

  AnalysisReport inspect(Context& context, model::State& state) override;

 private:
  CampbellSettings settings_;
};

}  // namespace culm::analysis
