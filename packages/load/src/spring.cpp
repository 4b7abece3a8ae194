#include "link_type.hpp"
#include "types.hpp"

namespace culm::load {

void register_spring(model::BuilderRegistry& registry) {
  Schema fields = point_pair_schema();
  fields.add(free_length_field());
  const auto make = [](const Options& options, model::BuildContext& context) {
    std::vector<Link> links;
    const std::vector<LinkPoint> points = select_points(options, context);
    if (!points.empty()) {
      links.push_back(distance_link(context.model.nodes(), points[0], points[1]));
    }
    set_free_length(options, links);
    return links;
  };
  register_spring_and_damper(
      registry, {"", "between two points, along the line from one to the other.", fields,
                 LinkUnits::lengths(), make});
}

}  // namespace culm::load
