#include <culm/base/nearest.hpp>
#include <culm/contact/beam_contact.hpp>
#include <culm/joint/triad_nodes.hpp>

#include "contact_fields.hpp"
#include "types.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace culm::contact {
namespace {

// Points so close that the place where beams cross at the depth of the deck is eight of them long.
constexpr double points_per_patch = 8.0;
constexpr std::size_t most_points = 1000;        // of an element
constexpr std::size_t most_node_pairs = 150000;  // each is 72 entries of the matrix

void check_beam_contact(const Options& options, InputIssues& issues) {
  const double reach = options.number("Radius") + options.number("Other Radius");
  if (options.number("Depth") > 0.25 * reach) {
    issues.add(options.where("Depth"),
               fmt::format("must be at most {:g} m, a quarter of both radii, got {:g}",
                           0.25 * reach, options.number("Depth")));
  }
}

Schema beam_contact_schema() {
  return Schema("Beam Contact",
                "Contact of two lines with round surfaces, wherever they cross or lie along each "
                "other, with friction.")
      .add(text("Structure", "The line, or the element set of lines."))
      .add(text("Other", "That which it shall not pass: a line, or an element set of lines."))
      .add(number("Radius", "m", "Of the surface of 'Structure' about its axis.").positive())
      .add(number("Other Radius", "m", "Of the surface of 'Other'.").positive())
      .add(number("Line Force", "N/m",
                  "Force per length of two lines along each other that lie 'Depth' deep in each "
                  "other; it grows with the power 3/2 of the depth.")
               .positive())
      .add(number("Depth", "m", "See 'Line Force'; at most a quarter of both radii.").positive())
      .add(number("Damping", "s/m",
                  "The force is multiplied by one plus this times the rate of the depth, and is "
                  "never negative.")
               .at_least(0.0)
               .optional(0.0))
      .add(friction_field())
      .add(slip_speed_field())
      .check(check_beam_contact);
}

// The elements of a line that a parameter names; none, and an issue, if it names none.
std::vector<LineElement> read_line(const Options& options, const std::string& parameter,
                                   double spacing, model::BuildContext& context) {
  const std::string& name = options.text(parameter);
  const std::vector<model::LinePoint> points = context.model.line_points(name);
  if (points.empty()) {
    std::vector<std::string> lines;
    for (const model::Structure& one : context.model.structures()) {
      if (!one.line_points.empty()) lines.push_back(one.name);
    }
    context.issues.add(
        options.where(parameter),
        "'" + name + "' is no line, nor an element set of lines" + did_you_mean(name, lines));
    return {};
  }
  for (const model::LinePoint& point : points) {
    if (!joint::have_triads(point.marker.nodes, parameter, options, context)) return {};
  }
  auto elements = divide(points, context.model.nodes().reference(), spacing);
  for (const LineElement& element : elements) {
    if (element.shapes.size() <= most_points) continue;
    context.issues.add(
        options.where("Depth"),
        fmt::format("asks for points {:.3g} m apart, {} of them in an element of '{}', where {} "
                    "are allowed: take a larger depth or more elements",
                    spacing, element.shapes.size(), name, most_points));
    return {};
  }
  return elements;
}

std::set<int> nodes_of(const std::vector<LineElement>& elements) {
  std::set<int> nodes;
  for (const LineElement& element : elements) {
    nodes.insert(element.nodes.begin(), element.nodes.end());
  }
  return nodes;
}

// Whether both lines are apart in the model, and the matrix can hold all that may touch.
bool may_meet(const std::vector<LineElement>& first, const std::vector<LineElement>& second,
              const Options& options, model::BuildContext& context) {
  const std::set<int> one = nodes_of(first);
  const std::set<int> other = nodes_of(second);
  for (const int node : one) {
    if (!other.contains(node)) continue;
    context.issues.add(options.where("Other"), "has nodes of 'Structure'");
    return false;
  }
  if (one.size() * other.size() > most_node_pairs) {
    context.issues.add(
        options.where("Other"),
        fmt::format("makes {} x {} = {} pairs of nodes that may touch, where {} are "
                    "allowed: name element sets of the parts that do",
                    one.size(), other.size(), one.size() * other.size(), most_node_pairs));
    return false;
  }
  return true;
}

void build_beam_contact(const Options& options, model::BuildContext& context) {
  const double radius = options.number("Radius");
  const double reach = radius + options.number("Other Radius");
  const double depth = options.number("Depth");
  // half the length of the place where beams cross at right angles is sqrt(2 R depth)
  const double spacing = 2.0 * std::sqrt(2.0 * reach * depth) / points_per_patch;
  auto first = read_line(options, "Structure", spacing, context);
  // other distances than on the first line: points that are abreast would all err alike
  auto second = read_line(options, "Other", 0.8 * spacing, context);
  if (first.empty() || second.empty() || !may_meet(first, second, options, context)) return;
  const Repulsion law =
      Repulsion::of_lines(reach, options.number("Line Force"), depth, options.number("Damping"));
  context.model.add_load(std::make_unique<BeamContact>(
      model::Effect("Beam Contact", options.name()), context.model.nodes(), law,
      read_friction(options), 2.0 * radius, std::move(first), std::move(second)));
}

}  // namespace

void register_beam_contact(model::BuilderRegistry& registry) {
  registry.add("Beam Contact", beam_contact_schema(), build_beam_contact);
}

}  // namespace culm::contact
