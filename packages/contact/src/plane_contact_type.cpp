#include <culm/contact/plane_contact.hpp>

#include "contact_fields.hpp"
#include "types.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace culm::contact {
namespace {

void check_plane_contact(const Options& options, InputIssues& issues) {
  check_contact_fields(options, issues);
  if (model::vector(options, "Normal").isZero(0.0)) {
    issues.add(options.where("Normal"), "must not be zero");
  }
}

Schema plane_contact_schema() {
  Schema fields("Plane Contact",
                "Contact of a line, or of spheres at nodes, with a fixed plane: a pressure that "
                "grows with the depth, with friction.");
  add_contact_fields(fields);
  fields.add(model::vector_field("Point", "m", "Of the plane.").optional({0.0, 0.0, 0.0}))
      .add(model::vector_field("Normal", "1",
                               "Of the plane, to the side of the structure, of any "
                               "length.")
               .optional({0.0, 0.0, 1.0}))
      .add(friction_field())
      .add(slip_speed_field())
      .check(check_plane_contact);
  return fields;
}

void build_plane_contact(const Options& options, model::BuildContext& context) {
  std::vector<ContactPoint> points = read_points(options, context);
  if (points.empty()) return;
  auto load = std::make_unique<PlaneContact>(
      model::Effect("Plane Contact", options.name()), context.model.nodes(),
      Plane{model::vector(options, "Point"), model::vector(options, "Normal").normalized()},
      read_penalty(options), read_friction(options));
  for (ContactPoint& point : points) load->add(std::move(point));
  context.model.add_load(std::move(load));
}

}  // namespace

void register_plane_contact(model::BuilderRegistry& registry) {
  registry.add("Plane Contact", plane_contact_schema(), build_plane_contact);
}

}  // namespace culm::contact
