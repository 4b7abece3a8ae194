#include "link_type.hpp"
#include "types.hpp"

namespace culm::load {

void register_directed_ground_spring(model::BuilderRegistry& registry) {
  Schema fields = ground_schema();
  joint::add_direction("Direction", "Direction in the reference, of any length.", fields);
  fields.add(frame_field("the node"));
  const auto make = [](const Options& options, model::BuildContext& context) {
    std::vector<Link> links;
    for (const LinkPoint& point : select_ground_points(options, context)) {
      links.push_back(directed_ground_link(context.model.nodes(), point,
                                           model::vector(options, "Direction").normalized(),
                                           follows(options)));
    }
    return links;
  };
  register_spring_and_damper(
      registry, {"Directed Ground", "on the displacement of a point along a direction.", fields,
                 LinkUnits::lengths(), make});
}

}  // namespace culm::load
