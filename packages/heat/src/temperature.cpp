#include <culm/heat/register_heat.hpp>

#include "heat_elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace culm::heat {
namespace {

// Whether a field has the same values at some times at all nodes of a structure, and at many times,
// each a twentieth later than the one before, at some of the nodes.
bool rests(const model::VectorField& field, const model::Structure& structure,
           const model::Model& model) {
  std::vector<double> many;
  for (double time = 1e-2; time < 1e6; time *= 1.05) many.push_back(time);
  const std::vector<double> few = {0.1, 1.0, 17.0, 1e3, 1e5};
  const std::size_t stride = 1 + structure.nodes.size() / 20;
  for (std::size_t i = 0; i < structure.nodes.size(); ++i) {
    const Vec3 place =
        model::NodeTable::slots(model.nodes().reference(), structure.nodes[i]).col(0);
    const Vec3 at_start = field.value(place, 0.0);
    const bool stays = std::ranges::all_of(i % stride == 0 ? many : few, [&](double time) {
      return field.value(place, time) == at_start;
    });
    if (!stays) return false;
  }
  return true;
}

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
  Temperatures temperatures{{options.number("Value")}, nullptr, *function};
  const std::vector<double>& gradient = options.numbers("Gradient");
  for (std::size_t i = 0; i < std::min<std::size_t>(gradient.size(), 2); ++i) {
    temperatures.everywhere.gradient[static_cast<Eigen::Index>(i)] = gradient[i];
  }
  if (options.has("Field")) {
    temperatures.field = model::find_field(options, context);
    if (temperatures.field == nullptr) return;
    if (!rests(*temperatures.field, *structure, context.model)) {
      context.issues.add(options.where("Field"),
                         "'" + options.text("Field") +
                             "' changes in time; a temperature takes the place from 'Field' and "
                             "the time from 'Function'");
      return;
    }
  } else if (temperatures.everywhere.value == 0.0 && temperatures.everywhere.gradient.isZero(0.0)) {
    context.issues.add(options.where(), "heats nothing: give 'Value', 'Gradient' or 'Field'");
    return;
  }
  const HeatRequest request{options, context, *structure, temperatures};
  const bool has_elements = !structure->cells.empty() && structure->cells.front().source != nullptr;
  if (has_elements && (heat_beams(request) || heat_shells(request))) return;
  context.issues.add(options.where("Structure"),
                     "structure '" + structure->name +
                         "' has no elements that expand; heat acts on beams and shells that are "
                         "not rigid");
}

}  // namespace

bool has_gradients(std::size_t size, const std::string& kind, const HeatRequest& request) {
  const std::size_t found = request.options.numbers("Gradient").size();
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
                   .add(text("Field",
                             "Entry of the list Fields with what is added by place in the "
                             "reference: its first component to 'Value', the others to "
                             "'Gradient'.")
                            .optional())
                   .add(model::function_field("Ramp")),
               build);
}

}  // namespace culm::heat
