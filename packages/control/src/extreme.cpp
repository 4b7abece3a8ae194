#include <culm/control/extreme.hpp>

#include "fields.hpp"

#include <memory>
#include <string>

namespace culm::control {
namespace {

void register_extreme(SignalRegistry& registry, const std::string& type, Extreme::Which which,
                      const std::string& doc) {
  Schema schema(type, doc);
  add_signals(schema);
  add_scale(schema);
  registry.add(type, schema, [which](const Options& options, ControlContext& context) {
    context.add(options, std::make_unique<Extreme>(which, options.number("Scale")), {"Signals"});
  });
}

}  // namespace

void register_extremes(SignalRegistry& registry) {
  register_extreme(registry, "Least", Extreme::Which::least, "The least of some signals.");
  register_extreme(registry, "Greatest", Extreme::Which::greatest, "The greatest of some signals.");
}

}  // namespace culm::control
