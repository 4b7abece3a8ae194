/// Motion in time.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/analysis/time_scheme.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

namespace culm::analysis {

/// How time is stepped.
struct DynamicsSettings {
  double end_time = 1.0;       ///< [s], from the time of the state
  double step = 0.01;          ///< [s]
  double smallest_step = 0.0;  ///< [s]; steps are not cut below
  solver::NewtonSettings newton;
};

/// Time integration with a fixed step, halved where an iteration fails and back on the grid of the
/// step as soon as possible. @source formulation 4.6b
class Dynamics final : public Analysis {
 public:
  Dynamics(DynamicsSettings settings, std::unique_ptr<TimeScheme> scheme)
      : settings_(std::move(settings)), scheme_(std::move(scheme)) {}

  static Schema schema();
  static std::unique_ptr<Analysis> make(const Options& options);

  AnalysisReport run(Context& context, model::State& state, Observer& observer) override;

 private:
  void prepare(Context& context, model::State& state);

  DynamicsSettings settings_;
  std::unique_ptr<TimeScheme> scheme_;
};

}  // namespace culm::analysis
