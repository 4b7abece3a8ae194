#include <culm/load/catenary_load.hpp>

#include "both_frames.hpp"
#include "link_type.hpp"
#include "types.hpp"

#include <fmt/format.h>

#include <memory>

namespace culm::load {
namespace {

Schema catenary_schema() {
  Schema fields("Catenary",
                "Mooring line at rest, without inertia and drag, from an anchor to a point.");
  fields.add_all(ground_schema())
      .add(model::vector_field("Anchor", "m", "Fixed end of the line, in space."))
      .add(number("Length", "m", "Unstretched.").positive())
      .add(number("EA", "N", "Stiffness of the line in tension.").positive())
      .add(number("Weight", "N/m", "Per unstretched length, less buoyancy.").positive())
      .add(flag("Seabed", "Whether the line rests on the plane of its anchor.").optional(true))
      .add(number("Friction", "1",
                  "Coefficient of the seabed against a line that is pulled out: the tension falls "
                  "towards the anchor by this times the weight.")
               .at_least(0.0)
               .optional(0.0))
      .add(model::vector_field("Up", "1", "Against gravity, of any length.")
               .optional({0.0, 0.0, 1.0}))
      .check([](const Options& options, InputIssues& issues) {
        if (model::vector(options, "Up").isZero(0.0)) {
          issues.add(options.where("Up"), "must not be zero");
        }
        if (!options.flag("Seabed") && options.number("Friction") > 0.0) {
          issues.add(options.where("Friction"), "is that of a seabed, but 'Seabed' is false");
        }
      });
  return fields;
}

// Below the plane on which its line rests a fairlead would carry nothing.
bool is_above_seabed(const LinkPoint& fairlead, const Options& options,
                     model::BuildContext& context) {
  const Vec3 anchor = model::vector(options, "Anchor");
  const Vec3 place = reference_of(context.model.nodes(), fairlead);
  const double height = model::vector(options, "Up").normalized().dot(place - anchor);
  constexpr double rounding = 1e-6;
  if (!options.flag("Seabed") || height >= -rounding * options.number("Length")) return true;
  context.issues.add(
      options.where("Anchor"),
      fmt::format("is {:.4g} m above the fairlead at '{}', but the line rests on the "
                  "plane of its anchor: take 'Seabed' = false where there is none",
                  -height, context.model.node_name(fairlead.node)));
  return false;
}

void build_catenary(const Options& options, model::BuildContext& context) {
  const auto points = select_ground_points(options, context);
  if (points.empty()) return;
  auto load = std::make_unique<CatenaryLoad>(effect_of("Catenary", options), context.model.nodes());
  const CatenaryLine line{options.number("Length"), options.number("EA"), options.number("Weight"),
                          options.flag("Seabed"), options.number("Friction")};
  for (const LinkPoint& point : points) {
    if (!is_above_seabed(point, options, context)) return;
    load->add(point, model::vector(options, "Anchor"), model::vector(options, "Up").normalized(),
              line);
  }
  context.model.add_load(std::move(load));
}

}  // namespace

void register_catenary(model::BuilderRegistry& registry) {
  registry.add("Catenary", catenary_schema(), build_catenary);
}

}  // namespace culm::load
