#include "link_type.hpp"
#include "types.hpp"

namespace culm::load {

void register_ground_spring(model::BuilderRegistry& registry) {
  Schema fields = ground_schema();
  fields
      .add(model::vector_field("Anchor", "m",
                               "Point in space; where the point is in the reference if absent.")
               .optional())
      .add(free_length_field());
  const auto make = [](const Options& options, model::BuildContext& context) {
    const model::NodeTable& nodes = context.model.nodes();
    std::vector<Link> links;
    for (const LinkPoint& point : select_ground_points(options, context)) {
      const Vec3 anchor =
          options.has("Anchor") ? model::vector(options, "Anchor") : reference_of(nodes, point);
      links.push_back(ground_link(nodes, point, anchor));
    }
    set_free_length(options, links);
    return links;
  };
  register_spring_and_damper(
      registry, {"Ground", "from a point to a fixed one, along the line to it.", fields,
                 LinkUnits::lengths(), make});
}

}  // namespace culm::load
