#include <culm/control/lag.hpp>

#include "fields.hpp"

#include <memory>

namespace culm::control {

void Lag::evaluate(const Unknowns& x, const Inputs& u, Values& values) const {
  const double rate = (command_.hold(u[0]) - x[0]) / time_constant_;
  const double slope = rate_.slope(rate) / time_constant_;
  values.f[0] = rate_.hold(rate);
  values.by_unknown(0, 0) = -slope;
  values.by_input(0, 0) = slope * command_.slope(u[0]);
}

void register_lag(SignalRegistry& registry) {
  Schema schema("Lag", "Follows a signal with a lag of first order, dy/dt = (u - y) / T.");
  schema.add(input_field()).add(number("Time Constant", "s", "T.").positive());
  add_actuator_fields(schema);
  registry.add("Lag", schema, [](const Options& options, ControlContext& context) {
    context.add(options,
                std::make_unique<Lag>(options.number("Time Constant"), read_rate(options),
                                      read_limits(options), options.number("Scale")),
                {"Signal"}, read_start(options));
  });
}

}  // namespace culm::control
