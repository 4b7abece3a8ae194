#include "link_type.hpp"

#include <culm/joint/triad_nodes.hpp>
#include <culm/load/link_load.hpp>

#include "both_frames.hpp"
#include "link_forms.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace culm::load {
namespace {

struct TableNames {
  std::string factor, arguments, values;
};

TableNames spring_names(const LinkUnits& units) {
  return {"Stiffness", units.coordinates, units.forces};
}
TableNames damper_names(const LinkUnits& units) { return {"Damping", "Rates", units.forces}; }

PiecewiseLinear read(const Options& options, const TableNames& names) {
  if (options.has(names.factor)) {
    return PiecewiseLinear::proportional(options.number(names.factor));
  }
  return {options.numbers(names.arguments), options.numbers(names.values)};
}

// Either the factor, or both lists of a table.
void check_table(const Options& options, const TableNames& names, InputIssues& issues) {
  const bool arguments = options.has(names.arguments);
  const bool values = options.has(names.values);
  const bool factor = options.has(names.factor);
  if (arguments != values || factor == arguments) {
    issues.add(options.where(), "needs either '" + names.factor + "' or '" + names.arguments +
                                    "' with '" + names.values + "'");
  } else if (arguments) {
    const std::string wrong =
        PiecewiseLinear::mistake(options.numbers(names.arguments), options.numbers(names.values));
    if (!wrong.empty()) issues.add(options.where(names.arguments), wrong);
  }
}

// F(v) v >= 0 for all v
void check_damper(const Options& options, const TableNames& names, InputIssues& issues) {
  if (!options.has(names.arguments) || !options.has(names.values)) return;
  const std::vector<double>& rates = options.numbers(names.arguments);
  const std::vector<double>& forces = options.numbers(names.values);
  if (!PiecewiseLinear::mistake(rates, forces).empty()) return;
  const PiecewiseLinear law(rates, forces);
  bool gives =
      law.value(0.0) != 0.0 || law.slope(rates.front()) < 0.0 || law.slope(rates.back()) < 0.0;
  for (std::size_t i = 0; i < rates.size(); ++i) gives = gives || rates[i] * forces[i] < 0.0;
  if (gives) {
    issues.add(
        options.where(names.values),
        "must be zero at rate 0 and else have the sign of the rate: a damper gives no energy");
  }
}

void add_table_fields(const TableNames& names, const std::string& argument_unit,
                      const std::string& value_unit, const std::string& factor_unit,
                      Schema& schema) {
  schema
      .add(number(names.factor, factor_unit, "Constant factor; a table stands in its place.")
               .non_negative()
               .optional())
      .add(numbers(names.arguments, argument_unit,
                   "Points of a table, rising; linear between them and beyond.")
               .optional())
      .add(numbers(names.values, value_unit, "Values at these points; they resist.").optional());
}

// A distance of zero has no direction, so nothing may pull there.
void check_zero_length(const Options& options, const LinkUnits& units,
                       const std::vector<Link>& links, model::BuildContext& context) {
  const PiecewiseLinear force = read_spring(options, units);
  for (const Link& link : links) {
    if (link.measure != Measure::distance && link.measure != Measure::radius) continue;
    const Vec<2> y = values_of(link, slots_of(link, context.model.nodes().reference()));
    if (y.norm() < 1e-24 && force.value(-link.rest) != 0.0) {
      context.issues.add(options.where(),
                         "pulls where the points coincide and no direction is known");
    }
  }
}

}  // namespace

void add_spring_fields(const LinkUnits& units, Schema& schema) {
  const TableNames names = spring_names(units);
  add_table_fields(names, units.coordinate_unit, units.force_unit,
                   units.force_unit + "/" + units.coordinate_unit, schema);
  schema.check([names](const Options& options, InputIssues& issues) {
    check_table(options, names, issues);
  });
}

void add_damper_fields(const LinkUnits& units, Schema& schema) {
  const TableNames names = damper_names(units);
  add_table_fields(names, units.coordinate_unit + "/s", units.force_unit,
                   units.force_unit + " s/" + units.coordinate_unit, schema);
  schema.check([names](const Options& options, InputIssues& issues) {
    check_table(options, names, issues);
    check_damper(options, names, issues);
  });
}

PiecewiseLinear read_spring(const Options& options, const LinkUnits& units) {
  return read(options, spring_names(units));
}

PiecewiseLinear read_damper(const Options& options, const LinkUnits& units) {
  return read(options, damper_names(units));
}

void register_link(model::BuilderRegistry& registry, const Schema& schema, MakeLinks make,
                   MakeLaw law) {
  const std::string type = schema.name();
  registry.add(type, schema, [=](const Options& options, model::BuildContext& context) {
    std::unique_ptr<LinkLaw> answers = law(options, context);
    std::vector<Link> links = make(options, context);
    if (!answers || links.empty()) return;
    auto load = std::make_unique<LinkLoad>(effect_of(type, options), context.model.nodes(),
                                           std::move(answers));
    for (Link& link : links) load->add(std::move(link));
    context.model.add_load(std::move(load));
  });
}

void register_spring_and_damper(model::BuilderRegistry& registry, const LinkType& type) {
  const std::string before = type.prefix.empty() ? "" : type.prefix + " ";
  Schema spring(before + "Spring", "Spring " + type.doc);
  spring.add_all(type.fields);
  add_spring_fields(type.units, spring);
  const auto make_spring = [type](const Options& options, model::BuildContext& context) {
    std::vector<Link> links = type.make(options, context);
    check_zero_length(options, type.units, links, context);
    return links;
  };
  register_link(registry, spring, make_spring,
                [units = type.units](const Options& options, model::BuildContext&) {
                  return std::make_unique<SpringLaw>(read_spring(options, units));
                });
  Schema damper(before + "Damper", "Damper " + type.doc);
  damper.add_all(type.fields);
  add_damper_fields(type.units, damper);
  register_link(registry, damper, type.make,
                [units = type.units](const Options& options, model::BuildContext&) {
                  return std::make_unique<DamperLaw>(read_damper(options, units));
                });
}

namespace {

// A direction can turn with a triad only.
void check_picture(const std::vector<int>& nodes, const std::string& parameter,
                   const Options& options, model::BuildContext& context) {
  const auto is_frame = [](const auto& field) { return field.name == "Frame"; };
  const auto& all = options.parameters();
  if (std::any_of(all.begin(), all.end(), is_frame) && follows(options)) {
    joint::have_triads(nodes, parameter, options, context);
  }
}

}  // namespace

Schema point_pair_schema() {
  const auto offset = [](const std::string& node) {
    return model::vector_field(node + " Offset", "m",
                               "From the node to the point, in its directors.")
        .optional({0.0, 0.0, 0.0});
  };
  return Schema("")
      .add(model::node_field("First", "Node of one point."))
      .add(model::node_field("Second", "Node of the other point."))
      .add(offset("First"))
      .add(offset("Second"));
}

std::vector<LinkPoint> select_points(const Options& options, model::BuildContext& context) {
  const auto nodes = joint::select_two_nodes(options, context);
  if (!nodes) return {};
  check_components("First Offset", std::span(nodes->data(), 1), options, context);
  check_components("Second Offset", std::span(nodes->data() + 1, 1), options, context);
  check_picture({(*nodes)[0]}, "First", options, context);
  return {{(*nodes)[0], model::vector(options, "First Offset")},
          {(*nodes)[1], model::vector(options, "Second Offset")}};
}

Schema ground_schema() { return Schema("").add(model::node_field()).add(offset_field()); }

std::vector<LinkPoint> select_ground_points(const Options& options, model::BuildContext& context) {
  std::vector<LinkPoint> points;
  const auto nodes = model::select_loaded_nodes(options, "Node", context);
  check_components("Offset", nodes, options, context);
  check_picture(nodes, "Node", options, context);
  for (int node : nodes) {
    points.push_back({node, model::vector(options, "Offset")});
  }
  return points;
}

Field frame_field(const std::string& node) {
  return choice("Frame", {"Space", "Node"},
                "Whether the direction stays in space or turns with " + node + ".")
      .optional("Space");
}

bool follows(const Options& options) { return options.text("Frame") == "Node"; }

Field free_length_field() {
  return number("Free Length", "m", "Distance without force; that of the reference if absent.")
      .non_negative()
      .optional();
}

void set_free_length(const Options& options, std::vector<Link>& links) {
  if (!options.has("Free Length")) return;
  for (Link& link : links) link.rest = options.number("Free Length");
}

}  // namespace culm::load
