#include "link_type.hpp"
#include "types.hpp"

namespace culm::load {

void register_directed_spring(model::BuilderRegistry& registry) {
  Schema fields = point_pair_schema();
  joint::add_direction("Direction", "Direction in the reference, of any length.", fields);
  fields.add(frame_field("the first node"));
  const auto make = [](const Options& options, model::BuildContext& context) {
    std::vector<Link> links;
    const std::vector<LinkPoint> points = select_points(options, context);
    if (!points.empty()) {
      links.push_back(directed_link(context.model.nodes(), points[0], points[1],
                                    model::vector(options, "Direction").normalized(),
                                    follows(options)));
    }
    return links;
  };
  register_spring_and_damper(
      registry, {"Directed", "between two points, in the part of their distance along a direction.",
                 fields, LinkUnits::lengths(), make});
}

}  // namespace culm::load
