/// Static equilibrium under loads that grow with the load level.
#pragma once

#include <culm/analysis/failure_trend.hpp>
#include <culm/analysis/post_mortem.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

#include <optional>
#include <vector>

namespace culm::analysis {

/// How the load level is raised.
struct StaticsSettings {
  double start_level = 0.0;
  double final_level = 1.0;
  double increment = 0.1;  ///< first increment of the level
  double smallest_increment = 1e-6;
  double largest_increment = 0.1;  ///< growth after easy steps ends here
  int easy_iterations = 6;         ///< steps with at most so many let the increment grow
  std::vector<double> levels;      ///< levels to be met exactly, rising
  solver::NewtonSettings newton;
};

/// Load control with automatic cut-back and growth of the increment. The level plays the role of
/// time in load functions. @source formulation 5.1
class Statics final : public Analysis {
 public:
  explicit Statics(StaticsSettings settings) : settings_(std::move(settings)) {}

  static Schema schema();
  static std::unique_ptr<Analysis> make(const Options& options);

  void save(const Context& context, Snapshot& snapshot) const override;

 private:
  void start(Context& context, model::State& state) override;
  void restore(Context& context, const Snapshot& snapshot) override;
  AnalysisReport advance(Context& context, model::State& state, Observer& observer) override;
  double next_level(double level, double increment) const;
  /// Warns where the structure lost or regained its stability in an accepted step.
  void watch_stability(const Context& context, const StepReport& report);

  StaticsSettings settings_;
  double increment_ = 0.0;
  int steps_ = 0;
  int determinant_sign_ = 0;  ///< of the tangent at the last equilibrium; 0 if unknown
  FailureTrend trend_;
  std::vector<double> crossings_;  ///< levels of the steps in which it changed
  std::optional<solver::NewtonSolver> newton_;
  std::optional<PostMortem> post_mortem_;
};

}  // namespace culm::analysis
