#include "contact_fields.hpp"

#include <culm/joint/triad_nodes.hpp>

namespace culm::contact {
namespace {

std::vector<ContactPoint> points_of_line(const Options& options, model::BuildContext& context) {
  const std::string& name = options.text("Structure");
  const double radius = options.number("Radius");
  const double width = options.has("Width") ? options.number("Width") : 2.0 * radius;
  std::vector<ContactPoint> points;
  for (const model::LinePoint& point : context.model.line_points(name)) {
    points.push_back({point.marker, radius, width * point.length, point.length});
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

}  // namespace

void add_contact_fields(Schema& schema) {
  schema.add(text("Structure", "The line, or the element set of lines.").optional())
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
      .add(number("Stiffness", "Pa/m", "Pressure per depth.").positive())
      .add(number("Smoothing", "m",
                  "Depth over which the stiffness sets in, half of it above the plane; 0: at once.")
               .at_least(0.0)
               .optional(0.0))
      .add(number("Damping", "s/m",
                  "The pressure is multiplied by one plus this times the rate of the depth, and is "
                  "never negative.")
               .at_least(0.0)
               .optional(0.0));
}

void check_contact_fields(const Options& options, InputIssues& issues) {
  if (options.has("Structure") == options.has("Node")) {
    issues.add(options.where(), "needs either 'Structure' or 'Node'");
  } else if (options.has("Node") != options.has("Area")) {
    issues.add(options.where(), "'Node' and 'Area' need each other");
  } else if (options.has("Structure") && !options.has("Width") && options.number("Radius") == 0.0) {
    issues.add(options.where(), "needs 'Width', or a 'Radius', half of it");
  } else if (options.has("Node") && options.has("Width")) {
    issues.add(options.where("Width"),
               "is that of a line, but the load acts on nodes: take 'Area'");
  }
}

std::vector<ContactPoint> read_points(const Options& options, model::BuildContext& context) {
  const bool line = options.has("Structure");
  auto points = line ? points_of_line(options, context) : points_of_nodes(options, context);
  for (ContactPoint& point : points) {
    if (!joint::have_triads(point.centre.nodes, line ? "Structure" : "Node", options, context)) {
      return {};
    }
    point.centre.offset += model::vector(options, "Offset");
  }
  return points;
}

Penalty read_penalty(const Options& options) {
  return {options.number("Stiffness"), options.number("Smoothing"), options.number("Damping")};
}

Field friction_field() {
  return number("Friction", "1", "Coefficient of friction.").at_least(0.0).optional(0.0);
}

Field slip_speed_field() {
  return number("Slip Speed", "m/s", "In dynamics, speed at which 71 % of the friction is there.")
      .positive()
      .optional(1e-3);
}

Friction read_friction(const Options& options) {
  return {options.number("Friction"), options.number("Slip Speed")};
}

}  // namespace culm::contact
