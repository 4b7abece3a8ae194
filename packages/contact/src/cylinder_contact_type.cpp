#include <culm/contact/cylinder_contact.hpp>
#include <culm/joint/triad_nodes.hpp>

#include "contact_fields.hpp"
#include "types.hpp"

#include <algorithm>
#include <memory>
#include <vector>

namespace culm::contact {
namespace {

Schema cylinder_contact_schema() {
  Schema fields("Cylinder Contact",
                "Contact of a line, or of spheres at nodes, with a round bar on a body or in "
                "space, with friction.");
  add_contact_fields(fields);
  fields.add(text("Body", "Node that the bar moves with; fixed in space without it.").optional())
      .add(model::vector_field("From", "m", "Begin of the axis, in the reference."))
      .add(model::vector_field("To", "m", "Its end."))
      .add(number("Bar Radius", "m", "Of the bar.").positive())
      .add(flag("Ends", "Whether the bar ends in half spheres about From and To, or goes on.")
               .optional(true))
      .add(friction_field())
      .add(slip_speed_field())
      .check([](const Options& options, InputIssues& issues) {
        check_contact_fields(options, issues);
        if (model::vector(options, "From") == model::vector(options, "To")) {
          issues.add(options.where("To"), "must not be 'From'");
        }
      });
  return fields;
}

std::optional<Cylinder> read_cylinder(const Options& options, model::BuildContext& context) {
  const Vec3 from = model::vector(options, "From");
  const Vec3 axis = model::vector(options, "To") - from;
  Cylinder cylinder{-1, from, axis.normalized(), {}, options.number("Bar Radius")};
  if (options.flag("Ends")) cylinder.length = axis.norm();
  if (!options.has("Body")) return cylinder;
  const std::vector<int> nodes = model::select_nodes(options, "Body", context);
  if (nodes.empty() || !joint::have_triads(nodes, "Body", options, context)) return {};
  if (nodes.size() > 1) {
    context.issues.add(options.where("Body"),
                       "must be one node, got " + std::to_string(nodes.size()));
    return {};
  }
  cylinder.node = nodes.front();
  const auto slots = model::NodeTable::slots(context.model.nodes().reference(), cylinder.node);
  const Mat3 triad = slots.rightCols<3>();
  cylinder.a = triad.transpose() * (from - slots.col(0));
  cylinder.along = triad.transpose() * cylinder.along;
  return cylinder;
}

void build_cylinder_contact(const Options& options, model::BuildContext& context) {
  const std::vector<ContactPoint> points = read_points(options, context);
  const std::optional<Cylinder> cylinder = read_cylinder(options, context);
  if (points.empty() || !cylinder) return;
  auto load = std::make_unique<CylinderContact>(model::Effect("Cylinder Contact", options.name()),
                                                context.model.nodes(), *cylinder,
                                                read_penalty(options), read_friction(options));
  for (const ContactPoint& point : points) {
    if (std::ranges::find(point.centre.nodes, cylinder->node) != point.centre.nodes.end()) {
      context.issues.add(options.where("Body"), "is a node of what it shall touch");
      return;
    }
    load->add(point);
  }
  context.model.add_load(std::move(load));
}

}  // namespace

void register_cylinder_contact(model::BuilderRegistry& registry) {
  registry.add("Cylinder Contact", cylinder_contact_schema(), build_cylinder_contact);
}

}  // namespace culm::contact
