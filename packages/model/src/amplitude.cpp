#include <culm/model/amplitude.hpp>

#include <algorithm>
#include <utility>

namespace culm::model {

Amplitude Amplitude::of_time(OfTime function) {
  Amplitude amplitude;
  amplitude.of_time_ = std::move(function);
  return amplitude;
}

Amplitude Amplitude::of_step(OfStep function) {
  Amplitude amplitude;
  amplitude.of_step_ = std::move(function);
  return amplitude;
}

Amplitude Amplitude::ramp() {
  Amplitude ramp = of_time([](double time) { return std::clamp(time, 0.0, 1.0); });
  return ramp.with_corners({0.0, 1.0});
}

Amplitude Amplitude::level() {
  return of_time([](double time) { return time; });
}

Amplitude Amplitude::constant(double value) {
  Amplitude amplitude = of_time([value](double) { return value; });
  amplitude.is_constant_ = true;
  return amplitude;
}

Amplitude Amplitude::of_signal(const Signal& signal) {
  Amplitude amplitude;
  amplitude.signal_ = signal;
  return amplitude;
}

Amplitude& Amplitude::with_corners(std::vector<double> times) {
  corners_ = std::move(times);
  return *this;
}

double Amplitude::in_step(const State& state, const Stencil& stencil) const {
  if (signal_) return signal_->in_step(state, stencil.theta);
  if (of_step_) return of_step_(state.time_prev, state.time);
  return of_time_((1.0 - stencil.theta) * state.time_prev + stencil.theta * state.time);
}

}  // namespace culm::model
