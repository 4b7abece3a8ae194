/// How long the steps of time are.
#pragma once

#include <culm/assembly/system.hpp>
#include <culm/base/snapshot.hpp>
#include <culm/solver/newton_solver.hpp>

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace culm::analysis {

/// Steps that follow from an estimate of their error.
struct AdaptiveSettings {
  double tolerance = 1e-5;     ///< error of a step [-], see StepControl::error
  double largest_step = 1e30;  ///< [s]
};

/// Settings of the steps.
struct StepSettings {
  double end_time = 1.0;       ///< [s]
  double step = 0.01;          ///< [s]; adaptive steps start from a sixteenth of it
  double smallest_step = 0.0;  ///< [s]; a step that fails and would be cut below ends the analysis
  std::optional<AdaptiveSettings> adaptive;  ///< none: fixed steps
};

/// What steps remember of the ones before: all that a continued run needs.
struct StepMemory {
  double next = 0.0;         ///< proposed length of the next step [s]
  double last = 0.0;         ///< length of the last accepted step [s]; 0 before the first
  double before_last = 0.0;  ///< of the one before [s]; 0 before the second
  bool failed = false;       ///< the last attempt was not accepted
  /// Means over the last accepted step and the last two, by differences of configurations: of the
  /// nodes this rank owns and zero elsewhere; empty with fixed steps.
  model::Coordinates velocity, acceleration;
};

/// Chooses the length of steps and judges those that Newton's method solved. Fixed steps are
/// halved where a step fails and return to the grid of the step as soon as possible; adaptive ones
/// follow an estimate of the error, c h^3 q'''. The third derivative is taken from configurations:
/// differences of accelerations would contain the part of the velocity that violates constraints,
/// which changes its sign in every step and does not fall with it. @source formulation 4.8
class StepControl {
 public:
  /// No node turns further in a step [rad], 160 degrees: mean directors vanish and rotations become
  /// ambiguous at pi.
  static constexpr double most_turn = 160.0 / 180.0 * std::numbers::pi;

  /// @param error_constant c of a scheme whose local error is c h^3 q'''
  /// @param stops          times that no adaptive step passes, rising [s]: what begins there would
  ///                       show in no estimate before
  StepControl(const assembly::System& system, const StepSettings& settings, double error_constant,
              std::vector<double> stops = {});

  /// End of the step that starts at `time`; the end of the analysis is met exactly.
  double end_of_step(double time) const;

  /// Looks at a step whose equations are solved; collective. @return converged, or why the step
  /// must be repeated with a smaller one
  solver::StepEnd judge(const model::State& state, const Stencil& stencil);
  /// After a step that judge accepted. @param taken its length [s]
  void accept(const model::State& state, double taken);
  /// After any other attempt. @param reason why it failed
  void reject(solver::StepEnd reason, double taken);
  /// Whether the next step would be smaller than allowed.
  bool is_exhausted() const { return memory_.next < settings_.smallest_step; }

  /// Error that the last judged step added, the largest of all slots with mass: positions over the
  /// length of the model, directors by 1. Not known in the first two steps.
  std::optional<double> error() const { return error_; }

  /// Largest turn of a node in the last judged step [rad].
  double turn() const { return 2.0 * std::atan(0.5 * turn_); }

  const StepMemory& memory() const { return memory_; }
  /// The memory, under "steps/".
  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

 private:
  model::NodeSlots mean_velocity(const model::State& state, double h, int node) const;
  model::NodeSlots mean_acceleration(const model::NodeSlots& velocity, double h, int node) const;
  double estimate_error(const model::State& state, double h) const;
  void remember(const model::State& state, double h);
  double largest_turn(const model::State& state) const;
  double growth() const;
  double next_stop(double time) const;

  const assembly::System& system_;
  StepSettings settings_;
  double error_constant_;
  std::vector<double> stops_;
  StepMemory memory_;
  std::optional<double> error_;
  double turn_ = 0.0;  ///< |tau| = 2 tan(angle / 2) of the last judged step, the largest of a node
  std::vector<double> slot_scale_;  ///< what an error counts, by slot; zero without mass
};

}  // namespace culm::analysis
