#include <culm/control/external_signal.hpp>

namespace culm::control {

void register_external_signal(SignalRegistry& registry) {
  Schema schema(
      "External",
      "A value that a program sets from step to step through the library; one of 'Initial' "
      "until it does.");
  schema.add(number("Initial", "1", "Value at the start.").optional(0.0));
  registry.add("External", schema, [](const Options& options, ControlContext& context) {
    const model::Signal signal =
        context.samples().add("External '" + options.name() + "'", options.number("Initial"));
    context.publish(options, signal);
    context.build().model.add_setting(options.name(), signal);
  });
}

}  // namespace culm::control
