/// Motion in time.
#pragma once

#include <culm/analysis/certificate.hpp>
#include <culm/analysis/cut_backs.hpp>
#include <culm/analysis/driven_corners.hpp>
#include <culm/analysis/missed_pulses.hpp>
#include <culm/analysis/predictor.hpp>
#include <culm/analysis/step_control.hpp>
#include <culm/analysis/stepper.hpp>
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

/// Says that a motion would end before it starts. Times in s.
std::string late_start(double start, double end);

/// Time integration with fixed or adaptive steps. @source formulation 4.6b
class Dynamics final : public Stepper {
 public:
  Dynamics(DynamicsSettings settings, std::unique_ptr<TimeScheme> scheme, Context& context,
           model::State& state);

  static Schema schema();
  static std::unique_ptr<Stepper> make(const Options& options, Context& context,
                                       model::State& state);

  double final_time() const override { return settings_.steps.end_time; }
  const StepControl& control() const { return control_; }
  const Certificate& certificate() const { return certificate_; }

 private:
  void do_fit() override;
  void do_begin() override;
  void do_prepare_resume() override;
  bool reaches_end() const override { return state().time_prev >= settings_.steps.end_time; }
  double propose() const override { return control_.end_of_step(state().time_prev); }
  StepReport do_attempt(double end) override;
  void do_accept(const StepReport& report) override;
  model::Coordinates end_velocity(const StepReport& report) const override {
    return scheme_->end_velocity(state(), report.increment);
  }
  bool do_fail(const StepReport& report) override;
  void do_discard() override;
  Stencil last_stencil() const override { return stencil_; }
  AnalysisReport do_finish() override;
  const char* kind() const override { return "Dynamic"; }
  void do_save(Snapshot& snapshot) const override;
  void do_restore(const Snapshot& snapshot) override;
  void refuse_other_schemes() const;
  void note_lagging_rates();
  void fit_motion();
  model::Coordinates first_acceleration(double first_step);
  /// @param fitted  becomes the velocity that constraints allow, see System::project_velocity
  /// @param solution  becomes the change of unknowns, with impulses in the place of multipliers
  /// @return none where a closed loop just passes a singular position
  std::optional<assembly::VelocityFit> find_fitting(model::Coordinates& fitted,
                                                    assembly::Vector& solution);
  double probe() const;
  double smallest_speed() const;
  void strike();
  void show_blow(double step);
  void take_blow_back();
  void measure_hidden_constraints();
  void keep_balance();
  void warn_of_short_step(double taken);

  DynamicsSettings settings_;
  std::unique_ptr<TimeScheme> scheme_;
  Stencil stencil_;       ///< of the last attempt
  bool is_first_ = true;  ///< no step was accepted yet
  StepControl control_;
  Predictor predictor_;
  CutBacks cut_backs_;
  Certificate certificate_;
  MissedPulses pulses_;
  DrivenCorners corners_;
  bool is_behind_corner_ = false;  ///< of a prescribed motion: velocities jump before the next step
  struct Blow {
    model::Coordinates velocity;   ///< before
    assembly::Vector multipliers;  ///< impulses that made it jump
    double work = 0.0;             ///< [J]
  };
  std::optional<Blow> blow_;  ///< with which the last attempt began
  Ledger::Id certificate_effect_ = 0;
};

}  // namespace culm::analysis
