#include <culm/heat/register_heat.hpp>

#include "heat_elements.hpp"

namespace culm::heat {
namespace {

void build(const Options& options, model::BuildContext& context) {
  const auto function = model::find_function(options, context);
  const model::Structure* structure = model::select_structure(options, context);
  if (!function || structure == nullptr) return;
  if (!function->is_function_of_time()) {
    context.issues.add(options.where("Function"),
                       "'" + options.text("Function") +
                           "' has one value per step; a temperature needs a function of time");
    return;
  }
  const auto& gradient = options.numbers("Gradient");
  const Temperature temperature{options.number("Value"), {gradient[0], gradient[1]}, *function};
  if (temperature.value == 0.0 && temperature.gradient.isZero(0.0)) {
    context.issues.add(options.where(), "heats nothing: give 'Value' or 'Gradient'");
    return;
  }
  if (!structure->cells.empty() && structure->cells.front().source != nullptr &&
      heat_beams({options, context, *structure, temperature})) {
    return;
  }
  context.issues.add(options.where("Structure"),
                     "structure '" + structure->name +
                         "' has no elements that expand; heat acts on beams that are not rigid");
}

}  // namespace

void register_heat(model::BuilderRegistry& registry) {
  registry.add("Temperature",
               Schema("Temperature",
                      "Temperature of a beam above that of its stress-free state: it expands by "
                      "the 'Expansion' of its sections.")
                   .add(model::structure_field())
                   .add(number("Value", "K", "Temperature on the axis.").optional(0.0))
                   .add(numbers("Gradient", "K/m", "Its rise along d1 and d2 of the section.")
                            .size(2)
                            .optional({0.0, 0.0}))
                   .add(model::function_field("Ramp")),
               build);
}

}  // namespace culm::heat
