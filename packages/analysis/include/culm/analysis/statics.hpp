/// Static equilibrium under loads that grow with the load level.
#pragma once

#include <culm/analysis/failure_trend.hpp>
#include <culm/analysis/missed_pulses.hpp>
#include <culm/analysis/stepper.hpp>
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
class Statics final : public Stepper {
 public:
  Statics(StaticsSettings settings, Context& context, model::State& state);

  static Schema schema();
  static std::unique_ptr<Stepper> make(const Options& options, Context& context,
                                       model::State& state);

  double final_time() const override { return settings_.final_level; }

 private:
  void do_begin() override;
  void do_prepare_resume() override { make_newton(settings_.newton); }
  bool reaches_end() const override { return state().time_prev >= settings_.final_level; }
  double propose() const override { return next_level(state().time_prev, increment_); }
  StepReport do_attempt(double level) override;
  void do_accept(const StepReport& report) override;
  bool do_fail(const StepReport& report) override;
  void explain_failure() override;
  std::optional<double> dead_end() const override { return trend_.end(settings_.final_level); }
  Stencil last_stencil() const override { return Stencil::statics(); }
  AnalysisReport do_finish() override;
  const char* kind() const override { return "Static"; }
  void do_save(Snapshot& snapshot) const override;
  void do_restore(const Snapshot& snapshot) override;
  double next_level(double level, double increment) const;
  double on_grid(double level) const;
  /// Whether the last stiffness resists some motion by no more than rounding.
  bool is_singular();
  void tell_unwatched(bool has_determinant);
  /// Of the stiffness at the end of a step; 0 if unknown.
  int find_determinant_sign(const StepReport& report);
  /// Warns where the structure lost or regained its stability in an accepted step.
  void watch_stability(const StepReport& report);
  bool flies_away();
  void watch_pairs(const StepReport& report);
  bool is_last(const StepReport& report) const { return report.time == settings_.final_level; }
  /// Throws NumericalError if something moves freely after the first step as well.
  void try_hanging();
  /// Measures the structure again once loads give it the stiffness that it had not at the start.
  void note_hanging();

  StaticsSettings settings_;
  std::optional<MissedPulses> pulses_;  ///< where something remembers its way
  double increment_ = 0.0;
  int determinant_sign_ = 0;     ///< of the tangent at the last equilibrium; 0 if unknown
  double first_log_size_ = 0.0;  ///< logarithm of the determinant of the first tangent
  bool has_unstable_pair_ = false;
  /// Something moves freely at the start, which may be held by what it carries from the first step.
  bool hangs_ = false;
  bool may_take_up_ = true;  ///< what acts at once at the start, which is tried last and once
  FailureTrend trend_;
  std::vector<double> crossings_;  ///< levels of the steps in which it changed
};

}  // namespace culm::analysis
