/// Motion that a support imposes.
#pragma once

#include <culm/math/types.hpp>
#include <culm/model/amplitude.hpp>

namespace culm::joint {

/// An angle [rad] or a distance [m] as a function of time.
struct Prescribed {
  double amount = 0.0;  ///< at function value 1
  model::Amplitude function = model::Amplitude::constant();

  /// Whether anything moves; a support that stands still may be eliminated.
  bool moves() const { return amount != 0.0; }
  /// @pre no signal is followed
  double at(double time) const { return amount * function.at(time); }
  /// The value at (1 - theta) prev + theta next of a step.
  double in_step(const model::State& state, double theta) const {
    if (const model::Signal* signal = function.signal())
      return amount * signal->in_step(state, theta);
    return at((1.0 - theta) * state.time_prev + theta * state.time);
  }
  /// Of a rate over the first part of a step, to (1 - theta) prev + theta next: of a function that
  /// is smooth between its corners to rounding, of one that jumps elsewhere, as a formula may, to a
  /// part in 1e4 of the step; of a signal with its mean over the step.
  double integral(const model::State& state, double theta) const;
};

/// A translation in space as a function of time.
struct Translation {
  Vec3 amount = Vec3::Zero();  ///< at function value 1 [m]
  model::Amplitude function = model::Amplitude::constant();

  bool moves() const { return !amount.isZero(0.0); }
  Vec3 at(double time) const { return amount * function.at(time); }
};

}  // namespace culm::joint
