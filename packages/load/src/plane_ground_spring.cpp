#include "link_type.hpp"
#include "types.hpp"

namespace culm::load {

void register_plane_ground_spring(model::BuilderRegistry& registry) {
  Schema fields = ground_schema();
  joint::add_direction("Normal", "Normal of the plane, of any length.", fields);
  const auto make = [](const Options& options, model::BuildContext& context) {
    std::vector<Link> links;
    for (const LinkPoint& point : select_ground_points(options, context)) {
      links.push_back(plane_ground_link(context.model.nodes(), point,
                                        model::vector(options, "Normal").normalized()));
    }
    return links;
  };
  register_spring_and_damper(
      registry, {"Plane Ground", "on the displacement of a point in a plane, towards its place.",
                 fields, LinkUnits::lengths(), make});
}

}  // namespace culm::load
