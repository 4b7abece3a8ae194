#include <culm/heat/register_heat.hpp>

#include "heat_elements.hpp"

#include <fmt/format.h>

#include <algorithm>

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
  const Temperature temperature{options.number("Value"), options.numbers("Gradient"), *function};
  const auto& gradient = temperature.gradient;
  const auto is_zero = [](double value) { return value == 0.0; };
  if (temperature.value == 0.0 && std::all_of(gradient.begin(), gradient.end(), is_zero)) {
    context.issues.add(options.where(), "heats nothing: give 'Value' or 'Gradient'");
    return;
  }
  const HeatRequest request{options, context, *structure, temperature};
  const bool has_elements = !structure->cells.empty() && structure->cells.front().source != nullptr;
  if (has_elements && (heat_beams(request) || heat_shells(request))) return;
  context.issues.add(options.where("Structure"),
                     "structure '" + structure->name +
                         "' has no elements that expand; heat acts on beams and shells that are "
                         "not rigid");
}

}  // namespace

bool has_gradients(std::size_t size, const std::string& kind, const HeatRequest& request) {
  const std::size_t found = request.temperature.gradient.size();
  if (found == 0 || found == size) return true;
  request.context.issues.add(
      request.options.where("Gradient"),
      fmt::format("must have {} value{} for the {} '{}', got {}", size, size == 1 ? "" : "s", kind,
                  request.structure.name, found));
  return false;
}

void register_heat(model::BuilderRegistry& registry) {
  registry.add("Temperature",
               Schema("Temperature",
                      "Temperature of a beam or a shell above that of its stress-free state: it "
                      "expands by the 'Expansion' of its sections or materials.")
                   .add(model::structure_field())
                   .add(number("Value", "K", "Temperature on the axis, or in the middle surface.")
                            .optional(0.0))
                   .add(numbers("Gradient", "K/m",
                                "Its rise: of a beam along d1 and d2 of the section, of a shell "
                                "along the director.")
                            .optional(std::vector<double>{}))
                   .add(model::function_field("Ramp")),
               build);
}

}  // namespace culm::heat
