#include <culm/control/integral.hpp>

#include "fields.hpp"

#include <memory>

namespace culm::control {

void register_integral(SignalRegistry& registry) {
  Schema schema("Integral", "Integral of a signal over time.");
  schema.add(input_field()).add(number("Gain", "1", "Factor.").optional(1.0));
  add_start(schema);
  registry.add("Integral", schema, [](const Options& options, ControlContext& context) {
    context.add(options,
                std::make_unique<Integral>(options.number("Gain"), options.number("Scale")),
                {"Signal"}, read_start(options));
  });
}

}  // namespace culm::control
