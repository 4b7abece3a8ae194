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
class Campbell final : public Inspection {
 public:
  explicit Campbell(CampbellSettings settings) : settings_(std::move(settings)) {}

  static Schema schema();
  static std::unique_ptr<Inspection> make(const Options& options);

  AnalysisReport inspect(Context& context, model::State& state) override;

 private:
  CampbellSettings settings_;
};

}  // namespace culm::analysis
