/// Forces between points, and moments between axes, as functions of how far they are apart.
#pragma once

#include <culm/load/piecewise_linear.hpp>
#include <culm/model/amplitude.hpp>
#include <culm/model/batch.hpp>

#include <utility>

namespace culm::load {

/// The force F [N, N m] that resists a change of the coordinate u [m, rad] of a link.
class LinkLaw {
 public:
  virtual ~LinkLaw() = default;

  struct Answer {
    double force = 0.0;
    double derivative = 0.0;  ///< by u at the end of the step
    double by_signal = 0.0;   ///< by the value of signal()
  };
  /// The force of a step in which the link goes from u = `prev` to `next`.
  virtual Answer answer(double prev, double next, const model::State& state,
                        const Stencil& stencil) const = 0;
  /// The signal that it follows; null if none.
  virtual const model::Signal* signal() const { return nullptr; }
  /// [J]
  virtual double energy(double u) const = 0;
  /// Books the work F (next - prev) that the force took.
  virtual void add_work(double force, double prev, double next, model::StepWork& work) const = 0;
};

/// W(u) = int F; the force of the conserving step is DW / Du, and F(u) in statics.
/// @source formulation 3.6
class SpringLaw final : public LinkLaw {
 public:
  explicit SpringLaw(PiecewiseLinear force) : force_(std::move(force)) {}
  const PiecewiseLinear& force() const { return force_; }

  Answer answer(double prev, double next, const model::State& state,
                const Stencil& stencil) const override;
  double energy(double u) const override { return force_.integral(u); }
  void add_work(double force, double prev, double next, model::StepWork& work) const override;

 private:
  PiecewiseLinear force_;
};

/// F(Du / dt), nothing in statics. @source formulation 3.6
class DamperLaw final : public LinkLaw {
 public:
  /// @pre mistake(force) is empty
  explicit DamperLaw(PiecewiseLinear force) : force_(std::move(force)) {}

  Answer answer(double prev, double next, const model::State& state,
                const Stencil& stencil) const override;
  double energy(double) const override { return 0.0; }
  void add_work(double force, double prev, double next, model::StepWork& work) const override;

 private:
  PiecewiseLinear force_;
};

/// What drives: F = -a(t), whatever u.
class DriveLaw final : public LinkLaw {
 public:
  DriveLaw(double amount, model::Amplitude function)
      : amount_(amount), function_(std::move(function)) {}

  Answer answer(double prev, double next, const model::State& state,
                const Stencil& stencil) const override;
  const model::Signal* signal() const override { return function_.signal(); }
  double energy(double) const override { return 0.0; }
  void add_work(double force, double prev, double next, model::StepWork& work) const override;

 private:
  double amount_;
  model::Amplitude function_;
};

}  // namespace culm::load
