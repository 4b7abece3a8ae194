/// Motion in time.
#pragma once

#include <culm/analysis/certificate.hpp>
#include <culm/analysis/cut_backs.hpp>
#include <culm/analysis/post_mortem.hpp>
#include <culm/analysis/predictor.hpp>
#include <culm/analysis/step_control.hpp>
#include <culm/analysis/time_scheme.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

#include <optional>

namespace culm::analysis {

/// How time is stepped.
struct DynamicsSettings {
  std::optional<double> start_time;  ///< [s]; the time of the state if absent
  StepSettings steps;
  Where end_time;  ///< where the deck says so
  Where scheme;    ///< where the deck chooses it
  solver::NewtonSettings newton;
};

/// Time integration with fixed or adaptive steps. @source formulation 4.6b
class Dynamics final : public Analysis {
 public:
  Dynamics(DynamicsSettings settings, std::unique_ptr<TimeScheme> scheme)
      : settings_(std::move(settings)), scheme_(std::move(scheme)) {}

  static Schema schema();
  static std::unique_ptr<Analysis> make(const Options& options);

  void save(const Context& context, Snapshot& snapshot) const override;

 private:
  void fit(Context& context, model::State& state) override;
  void start(Context& context, model::State& state) override;
  void restore(Context& context, const Snapshot& snapshot) override;
  AnalysisReport advance(Context& context, model::State& state, Observer& observer) override;
  void fit_motion(Context& context, model::State& state) const;
  void measure_hidden_constraints(Context& context, const model::State& state);

  DynamicsSettings settings_;
  std::unique_ptr<TimeScheme> scheme_;
  int steps_ = 0;
  std::optional<StepControl> control_;
  std::optional<Predictor> predictor_;
  CutBacks cut_backs_;
  std::optional<solver::NewtonSolver> newton_;
  std::optional<PostMortem> post_mortem_;
  std::optional<Certificate> certificate_;
};

}  // namespace culm::analysis
