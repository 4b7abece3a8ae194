#include <culm/control/integral.hpp>

#include "fields.hpp"

#include <memory>

namespace culm::control {

void register_integral(SignalRegistry& registry) {
  Schema schema("Integral", "Integral of a signal over time.");
  schema.add(input_field())
      .add(number("Gain", "1", "Factor.").optional(1.0))
      .add(number("Tracking Time", "s", "In which it comes back from beyond its limits.")
               .positive()
               .optional(0.1));
  add_limits(schema);
  add_start(schema);
  registry.add("Integral", schema, [](const Options& options, ControlContext& context) {
    context.add(options,
                std::make_unique<Integral>(options.number("Gain"), options.number("Scale"),
                                           read_limits(options), options.number("Tracking Time")),
                {"Signal"}, read_start(options));
  });
}

}  // namespace culm::control
