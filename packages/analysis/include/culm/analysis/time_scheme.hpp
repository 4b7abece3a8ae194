/// How a step of time is cut.
#pragma once

#include <culm/assembly/system.hpp>
#include <culm/base/snapshot.hpp>
#include <culm/mechanics/stencil.hpp>
#include <culm/model/state.hpp>

#include <string>

namespace culm::analysis {

/// Relates accelerations and velocities to the configurations at both ends of a step.
class TimeScheme {
 public:
  virtual ~TimeScheme() = default;
  virtual std::string name() const = 0;
  /// Whether energy and momenta obey exact balances.
  virtual bool conserves() const = 0;
  /// Whether forces act in the middle of steps, so that force by way is their work.
  virtual bool shows_work() const = 0;
  /// c of the error c h^3 q''' that a step adds to positions.
  virtual double error_constant() const = 0;
  /// Once, with the acceleration of the start [m/s^2, 1/s^2].
  virtual void start(model::Coordinates acceleration) = 0;
  /// Before a step of length h [s]: sets state.acceleration_offset. @return the step's stencil
  virtual Stencil begin(model::State& state, double h) = 0;
  /// What velocities are at the end of the step that begin() began, as state.next has it.
  virtual model::Coordinates end_velocity(const model::State& state, double h) const = 0;
  /// After an accepted step, before prev takes the place of next: sets state.velocity.
  virtual void finish(model::State& state, double h) = 0;
  /// What the scheme remembers beside position and velocity, under "scheme/"; see Analysis.
  virtual void save(const assembly::System&, Snapshot&) const {}
  virtual void restore(const assembly::System&, const Snapshot&) {}
};

/// Energy-momentum conserving: mean velocity, forces at mid-step, mean of the end strains.
/// @source formulation 4.1
class ConservingScheme final : public TimeScheme {
 public:
  std::string name() const override { return "Conserving"; }
  bool conserves() const override { return true; }
  bool shows_work() const override { return true; }
  double error_constant() const override { return 1.0 / 12.0; }
  void start(model::Coordinates) override {}
  Stencil begin(model::State& state, double h) override;
  model::Coordinates end_velocity(const model::State& state, double h) const override;
  void finish(model::State& state, double h) override;
};

/// Generalised-alpha on the same equations, for comparison: second order, dissipates what the step
/// does not resolve, keeps neither energy nor momenta.
/// @source Chung, Hulbert, J. Appl. Mech. 60 (1993) 371-375; as an integrator of constrained
/// systems: Arnold, Bruls, Multibody Syst. Dyn. 18 (2007) 185-202
class GeneralisedAlphaScheme : public TimeScheme {
 public:
  /// @param spectral_radius at infinite frequency, in [0, 1]
  explicit GeneralisedAlphaScheme(double spectral_radius);
  std::string name() const override { return "Generalised Alpha"; }
  bool conserves() const override { return false; }
  bool shows_work() const override { return alpha_f_ == 0.5; }
  double error_constant() const override;
  void start(model::Coordinates acceleration) override;
  Stencil begin(model::State& state, double h) override;
  model::Coordinates end_velocity(const model::State& state, double h) const override;
  void finish(model::State& state, double h) override;
  void save(const assembly::System& system, Snapshot& snapshot) const override;
  void restore(const assembly::System& system, const Snapshot& snapshot) override;

 protected:
  /// @param alpha_m, alpha_f  weights of the start of the step in inertia and in all other forces
  GeneralisedAlphaScheme(double alpha_m, double alpha_f);

 private:
  model::Coordinates end_acceleration(const model::State& state, double h) const;
  void bring_to_end(model::Coordinates& velocity, const model::Coordinates& end_acceleration,
                    double h) const;

  double alpha_m_, alpha_f_, beta_, gamma_;
  model::Coordinates acceleration_;
};

/// The trapezoidal rule of Newmark (beta 1/4, gamma 1/2), for comparison: equations at the end of
/// the step. It is stable for linear systems only.
/// @source Newmark, J. Eng. Mech. Div. ASCE 85 (1959) 67-94
class TrapezoidalScheme final : public GeneralisedAlphaScheme {
 public:
  TrapezoidalScheme() : GeneralisedAlphaScheme(0.0, 0.0) {}
  std::string name() const override { return "Trapezoidal"; }
};

}  // namespace culm::analysis
