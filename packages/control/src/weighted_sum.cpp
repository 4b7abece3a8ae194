#include <culm/control/weighted_sum.hpp>

#include "fields.hpp"

#include <memory>

namespace culm::control {

void register_weighted_sum(SignalRegistry& registry) {
  Schema schema("Sum", "Offset + sum of gains times signals.");
  schema.add(texts("Signals", "Names of up to eight signals or functions.").min_size(1))
      .add(numbers("Gains", "1", "A factor for each.").min_size(1))
      .add(number("Offset", "1", "What is added.").optional(0.0));
  add_limits(schema);
  add_scale(schema);
  schema.check([](const Options& options, InputIssues& issues) {
    const std::size_t count = options.texts("Signals").size();
    if (count > Block::max_inputs) {
      issues.add(options.where("Signals"), "must be up to " + std::to_string(Block::max_inputs) +
                                               ", got " + std::to_string(count));
    }
    if (count == options.numbers("Gains").size()) return;
    issues.add(options.where("Gains"), "must be as many as 'Signals', which are " +
                                           std::to_string(count) + "; got " +
                                           std::to_string(options.numbers("Gains").size()));
  });
  registry.add("Sum", schema, [](const Options& options, ControlContext& context) {
    const std::vector<double>& gains = options.numbers("Gains");
    context.add(
        options,
        std::make_unique<WeightedSum>(options.number("Offset"),
                                      Eigen::Map<const Eigen::VectorXd>(
                                          gains.data(), static_cast<Eigen::Index>(gains.size())),
                                      read_limits(options), options.number("Scale")),
        {"Signals"});
  });
}

}  // namespace culm::control
