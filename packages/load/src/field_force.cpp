#include <culm/base/error.hpp>
#include <culm/load/field_load.hpp>

#include "both_frames.hpp"
#include "line.hpp"
#include "types.hpp"

#include <memory>

namespace culm::load {
namespace {

// One number for all components, by weights that no formula is made of.
model::Amplitude variation_of(const model::SharedField& field, const Vec3& place) {
  const Vec3 weights(1.0, 0.73, 0.58);
  return model::Amplitude::of_time([=](double time) {
    try {
      return weights.dot(field->value(place, time));
    } catch (const InputError&) {
      return 0.0;  // not finite at a time for which no step may ask
    }
  });
}

void build_field_force(const Options& options, model::BuildContext& context) {
  const auto function = model::find_function(options, context);
  const auto field = model::find_field(options, context);
  const auto points = line_points(options, context);
  if (!function || !field || points.empty()) return;
  check_components("Offset", points.front().marker.nodes, options, context);
  auto load = std::make_unique<FieldLoad>(effect_of("Field Force", options), context.model.nodes(),
                                          *function, field);
  for (model::LinePoint point : points) {
    point.marker.offset += model::vector(options, "Offset");
    load->add(point.marker, options.number("Factor") * point.length);
  }
  if (field->varies_in_time()) {
    const int first = points.front().marker.nodes.front();
    const Vec3 place = model::NodeTable::slots(context.model.nodes().reference(), first).col(0);
    context.model.add_variation("the field of " + load->effect().quoted(),
                                variation_of(field, place));
  }
  context.model.add_load(std::move(load));
}

}  // namespace

void register_field_force(model::BuilderRegistry& registry) {
  registry.add("Field Force",
               Schema("Field Force",
                      "Force per reference length of a line by a field, at the places where the "
                      "line is.")
                   .add(line_field())
                   .add(offset_field())
                   .add(text("Field", "Name of an entry of the list Fields, in N/m."))
                   .add(number("Factor", "1", "Factor on the field.").optional(1.0))
                   .add(model::function_field("Ramp")),
               build_field_force);
}

}  // namespace culm::load
