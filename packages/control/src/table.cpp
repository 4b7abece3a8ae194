#include <culm/control/table.hpp>

#include "fields.hpp"

#include <memory>
#include <string>
#include <vector>

namespace culm::control {

void register_table(SignalRegistry& registry) {
  Schema schema("Table",
                "A function of a signal, linear between its points, constant beyond them.");
  schema.add(input_field())
      .add(numbers("Arguments", "1", "The signal at the points, increasing.").min_size(2))
      .add(numbers("Values", "1", "The output there.").min_size(2));
  add_scale(schema);
  schema.check([](const Options& options, InputIssues& issues) {
    const std::string wrong =
        load::PiecewiseLinear::mistake(options.numbers("Arguments"), options.numbers("Values"));
    if (!wrong.empty()) issues.add(options.where("Arguments"), wrong);
  });
  registry.add("Table", schema, [](const Options& options, ControlContext& context) {
    const std::vector<double>& arguments = options.numbers("Arguments");
    context.add(options,
                std::make_unique<Table>(load::PiecewiseLinear(arguments, options.numbers("Values")),
                                        Limits{arguments.front(), arguments.back()},
                                        options.number("Scale")),
                {"Signal"});
  });
}

}  // namespace culm::control
