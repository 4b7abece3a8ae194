#include <culm/control/weighted_sum.hpp>

#include "fields.hpp"

#include <memory>

namespace culm::control {

void register_weighted_sum(SignalRegistry& registry) {
  Schema schema("Sum", "Offset + sum of gains times signals.");
  add_signals(schema);
  schema.add(numbers("Gains", "1", "A factor for each.").min_size(1))
      .add(number("Offset", "1", "What is added.").optional(0.0));
  add_limits(schema);
  add_scale(schema);
  schema.check([](const Options& options, InputIssues& issues) {
    check_one_each(options, "Gains", issues);
  });
  registry.add("Sum", schema, [](const Options& options, ControlContext& context) {
    context.add(
        options,
        std::make_unique<WeightedSum>(options.number("Offset"), as_inputs(options.numbers("Gains")),
                                      read_limits(options), options.number("Scale")),
        {"Signals"});
  });
}

}  // namespace culm::control
