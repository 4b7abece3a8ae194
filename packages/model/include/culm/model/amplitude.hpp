/// How loads and prescribed motions vary in time.
#pragma once

#include <culm/base/registry.hpp>
#include <culm/mechanics/stencil.hpp>
#include <culm/model/own_unknowns.hpp>
#include <culm/model/state.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace culm::model {

/// A factor in time: a function, or an unknown of a batch that is followed. Time is the load
/// parameter in statics. A value: copies are independent.
class Amplitude {
 public:
  using OfTime = std::function<double(double time)>;
  using OfStep = std::function<double(double start, double end)>;

  /// A function of time alone.
  static Amplitude of_time(OfTime function);
  /// One value per step, from the times of its ends: impulses, noise.
  static Amplitude of_step(OfStep function);
  /// Time, held between 0 and 1: the load parameter of a static analysis.
  static Amplitude ramp();
  /// Time: the load parameter of a path, which goes below 0 and beyond 1.
  static Amplitude level();
  static Amplitude constant(double value = 1.0);
  /// Follows an unknown, implicitly: who asks for it couples its blocks to that of the unknown.
  static Amplitude of_signal(const Signal& signal);

  /// Says where the pieces of a function of time meet, its corners and jumps. @param times  rising
  Amplitude& with_corners(std::vector<double> times);
  /// Empty where they are not known.
  const std::vector<double>& corners() const { return corners_; }

  /// Null where it is a function.
  const Signal* signal() const { return signal_ ? &*signal_ : nullptr; }
  /// What acts in a step: the value at (1 - theta) time_prev + theta time, or that of the step.
  /// @source formulation 3.5
  double in_step(const State& state, const Stencil& stencil) const;

  /// A prescribed motion needs a function of time alone.
  bool is_function_of_time() const { return static_cast<bool>(of_time_); }
  /// The same at all times.
  bool is_constant() const { return is_constant_; }
  /// @pre is_function_of_time()
  double at(double time) const { return of_time_(time); }

 private:
  Amplitude() = default;  // without a function; for the makers above

  bool is_constant_ = false;
  std::optional<Signal> signal_;
  OfTime of_time_;
  OfStep of_step_;
  std::vector<double> corners_;
};

/// All types of the deck's list "Functions".
void register_amplitudes(Registry<Amplitude>& registry);

}  // namespace culm::model
