/// Motion in time.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/analysis/certificate.hpp>
#include <culm/analysis/step_control.hpp>
#include <culm/analysis/time_scheme.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

namespace culm::analysis {

/// How time is stepped.
struct DynamicsSettings {
  StepSettings steps;
  Where scheme;  ///< where the deck chooses it
  solver::NewtonSettings newton;
};

/// Time integration with fixed or adaptive steps. @source formulation 4.6b
class Dynamics final : public Analysis {
 public:
  Dynamics(DynamicsSettings settings, std::unique_ptr<TimeScheme> scheme)
      : settings_(std::move(settings)), scheme_(std::move(scheme)) {}

  static Schema schema();
  static std::unique_ptr<Analysis> make(const Options& options);

  AnalysisReport run(Context& context, model::State& state, Observer& observer) override;

 private:
  void prepare(Context& context, model::State& state);
  void measure_hidden_constraints(Context& context, const model::State& state,
                                  Certificate& certificate) const;

  DynamicsSettings settings_;
  std::unique_ptr<TimeScheme> scheme_;
};

}  // namespace culm::analysis
