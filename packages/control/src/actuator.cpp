#include <culm/control/actuator.hpp>

#include "fields.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace culm::control {

void Actuator::evaluate(const Unknowns& x, const Inputs& u, Values& values) const {
  const double inverse_lag = 2.0 * zeta_ * omega_;
  const double gain = omega_ / (2.0 * zeta_);
  const double wanted = gain * (command_.hold(u[0]) - x[0]);
  const double slope = inverse_lag * rate_.slope(wanted) * gain;
  values.f[0] = x[1];
  values.f[1] = inverse_lag * (rate_.hold(wanted) - x[1]);
  values.by_unknown(0, 1) = 1.0;
  values.by_unknown(1, 0) = -slope;
  values.by_unknown(1, 1) = -inverse_lag;
  values.by_input(1, 0) = slope * command_.slope(u[0]);
}

// Poles are omega (-zeta +- sqrt(zeta^2 - 1)).
double Actuator::fastest() const {
  const double beyond = std::sqrt(std::max(zeta_ * zeta_ - 1.0, 0.0));
  return omega_ * (std::max(zeta_, 1.0) + beyond);
}

void register_actuator(SignalRegistry& registry) {
  Schema schema("Actuator",
                "Follows a signal as an oscillator does, y'' + 2 D w y' + w^2 (y - u) = 0.");
  schema.add(input_field())
      .add(number("Frequency", "Hz", "Undamped frequency w / 2 pi.").positive())
      .add(number("Damping Ratio", "1", "D.").positive().optional(0.7));
  add_actuator_fields(schema);
  registry.add("Actuator", schema, [](const Options& options, ControlContext& context) {
    context.add(options,
                std::make_unique<Actuator>(2.0 * std::numbers::pi * options.number("Frequency"),
                                           options.number("Damping Ratio"), read_rate(options),
                                           read_limits(options), options.number("Scale")),
                {"Signal"}, read_start(options));
  });
}

}  // namespace culm::control
