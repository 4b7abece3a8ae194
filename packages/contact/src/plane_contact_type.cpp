#include <culm/contact/plane_contact.hpp>
#include <culm/contact/register_contact.hpp>
#include <culm/joint/triad_nodes.hpp>

#include <memory>
#include <utility>
#include <vector>

namespace culm::contact {
namespace {

void check(const Options& options, InputIssues& issues) {
  if (options.has("Structure") == options.has("Node")) {
    issues.add(options.where(), "needs either 'Structure' or 'Node'");
  } else if (options.has("Node") != options.has("Area")) {
    issues.add(options.where(), "'Node' and 'Area' need each other");
  } else if (options.has("Structure") && !options.has("Width") && options.number("Radius") == 0.0) {
    issues.add(options.where(), "needs 'Width', or a 'Radius', half of it");
  }
  if (model::vector(options, "Normal").isZero(0.0)) {
    issues.add(options.where("Normal"), "must not be zero");
  }
}

Schema schema() {
  Schema fields("Plane Contact",
                "Contact of a line, or of spheres at nodes, with a fixed plane: a pressure that "
                "grows with the depth, with friction.");
  fields.add(text("Structure", "The line, or the element set of lines.").optional())
      .add(text("Node",
                "Nodes instead, each with a sphere: 'structure/set', 'structure/number' or "
                "'structure'.")
               .optional())
      .add(model::vector_field("Offset", "m", "Of the centres, in the directors.")
               .optional({0.0, 0.0, 0.0}))
      .add(number("Radius", "m", "Of the round surface about the centres.")
               .at_least(0.0)
               .optional(0.0))
      .add(number("Width", "m", "Of a line that is pressed; twice the radius if absent.")
               .positive()
               .optional())
      .add(number("Area", "m^2", "Of each sphere that is pressed.").positive().optional())
      .add(model::vector_field("Point", "m", "Of the plane.").optional({0.0, 0.0, 0.0}))
      .add(model::vector_field("Normal", "1",
                               "Of the plane, to the side of the structure, of any "
                               "length.")
               .optional({0.0, 0.0, 1.0}))
      .add(number("Stiffness", "Pa/m", "Pressure per depth.").positive())
      .add(number("Smoothing", "m",
                  "Depth over which the stiffness sets in, half of it above the plane; 0: at once.")
               .at_least(0.0)
               .optional(0.0))
      .add(number("Damping", "s/m",
                  "The pressure is multiplied by one plus this times the rate of the depth, and is "
                  "never negative.")
               .at_least(0.0)
               .optional(0.0))
      .add(number("Friction", "1", "Coefficient of friction, in dynamics.")
               .at_least(0.0)
               .optional(0.0))
      .add(number("Slip Speed", "m/s", "Speed at which 71 % of the friction is there.")
               .positive()
               .optional(1e-3))
      .check(check);
  return fields;
}

std::vector<ContactPoint> points_of_line(const Options& options, model::BuildContext& context) {
  const std::string& name = options.text("Structure");
  const double radius = options.number("Radius");
  const double width = options.has("Width") ? options.number("Width") : 2.0 * radius;
  std::vector<ContactPoint> points;
  for (const model::LinePoint& point : context.model.line_points(name)) {
    points.push_back({point.marker, radius, width * point.length});
  }
  // select_structure reports a name that is neither a set nor a structure
  if (points.empty() && model::select_structure(options, context) != nullptr) {
    context.issues.add(options.where("Structure"),
                       "structure '" + name + "' is not a line: name its nodes instead");
  }
  return points;
}

std::vector<ContactPoint> points_of_nodes(const Options& options, model::BuildContext& context) {
  std::vector<ContactPoint> points;
  for (const int node : model::select_loaded_nodes(options, "Node", context)) {
    points.push_back({model::marker_at(node), options.number("Radius"), options.number("Area")});
  }
  return points;
}

void build(const Options& options, model::BuildContext& context) {
  const bool line = options.has("Structure");
  auto points = line ? points_of_line(options, context) : points_of_nodes(options, context);
  if (points.empty()) return;
  for (ContactPoint& point : points) {
    if (!joint::have_triads(point.centre.nodes, line ? "Structure" : "Node", options, context)) {
      return;
    }
    point.centre.offset += model::vector(options, "Offset");
  }
  auto load = std::make_unique<PlaneContact>(
      model::Effect("Plane Contact", options.name()), context.model.nodes(),
      Plane{model::vector(options, "Point"), model::vector(options, "Normal").normalized()},
      Penalty{options.number("Stiffness"), options.number("Smoothing"), options.number("Damping")},
      Friction{options.number("Friction"), options.number("Slip Speed")});
  for (ContactPoint& point : points) load->add(std::move(point));
  context.model.add_load(std::move(load));
}

}  // namespace

void register_contact(model::BuilderRegistry& registry) {
  registry.add("Plane Contact", schema(), build);
}

}  // namespace culm::contact
