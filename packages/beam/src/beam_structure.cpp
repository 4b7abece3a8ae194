#include <culm/beam/axis_types.hpp>
#include <culm/beam/beam_structure.hpp>
#include <culm/math/rotation.hpp>
#include <culm/model/velocity_dissipation.hpp>

#include "element_families.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace culm::beam {

namespace {

AxisRegistry axes() {
  AxisRegistry registry;
  register_axes(registry);
  return registry;
}

// Elements of one order need not name it.
int read_order(const ElementFamilies& families, const Options& options) {
  const std::vector<int> orders = families.orders(options.text("Element"));
  return orders.size() == 1 ? orders.front() : options.integer("Order");
}

const ElementFamily* find_family(const ElementFamilies& families, const Options& options) {
  return families.find(options.text("Element"), read_order(families, options),
                       options.text("Fidelity"), options.flag("Torsion"));
}

// What a choice that no family has could be instead, by the parameter that is wrong.
void check_choice(const ElementFamilies& families, const Options& beam, InputIssues& issues) {
  const std::string& element = beam.text("Element");
  const std::vector<int> orders = families.orders(element);
  if (beam.given("Order") && std::ranges::find(orders, beam.integer("Order")) == orders.end()) {
    issues.add(beam.where("Order"), fmt::format("must be {} for '{}' elements: leave it out",
                                                fmt::join(orders, ", "), element));
  }
  if (find_family(families, beam) != nullptr) return;
  const int order = read_order(families, beam);
  std::vector<std::string> fidelities;
  std::vector<std::string> untwisted;
  for (const ElementFamily& family : families.all()) {
    if (family.element != element || family.order != order) continue;
    (family.twists ? fidelities : untwisted).push_back(family.fidelity);
  }
  const auto quoted = [](const std::vector<std::string>& names) {
    return fmt::format("'{}'", fmt::join(names, "', '"));
  };
  if (std::ranges::find(fidelities, beam.text("Fidelity")) == fidelities.end()) {
    issues.add(beam.where("Fidelity"),
               fmt::format("of '{}' elements must be one of {}", element, quoted(fidelities)));
  } else if (untwisted.empty()) {
    issues.add(beam.where("Torsion"), fmt::format("must be true for '{}' elements", element));
  } else {
    issues.add(beam.where("Torsion"),
               fmt::format("false needs a 'Fidelity' of {}", quoted(untwisted)));
  }
}

std::vector<int> add_nodes(const Chain& chain, const SectionTable& sections, model::Model& model,
                           model::Structure& structure) {
  std::vector<int> numbers;
  numbers.reserve(chain.size());
  for (const AxisNode& node : chain) {
    model::NodeSlots slots;
    slots << node.position, node.triad;
    numbers.push_back(model.nodes().add(slots));
    // no entries where no node has an outline
    if (auto outline = sections.at(node.span).outline; !outline.empty()) {
      structure.outlines.resize(structure.nodes.size() + numbers.size());
      structure.outlines.back() = std::move(outline);
    }
    if (std::abs(node.span - 0.5) < 1e-9) structure.sets["middle"].push_back(numbers.back());
  }
  structure.nodes.insert(structure.nodes.end(), numbers.begin(), numbers.end());
  return numbers;
}

// Moves and turns the nodes of an axis.
void deviate(const model::Imperfection& imperfection, const std::string& name, Axis& axis) {
  std::size_t count = 0;
  for (const Chain& chain : axis.chains) count += chain.size();
  const std::vector<Vec6>& motions = imperfection.of(name, count);
  if (motions.empty()) return;
  auto motion = motions.begin();
  for (Chain& chain : axis.chains) {
    for (AxisNode& node : chain) {
      node.position += motion->head<3>();
      node.triad = exp_rotation(motion->tail<3>()) * node.triad;
      ++motion;
    }
  }
}

// Lengths near the ends of the range of numbers lose their squares.
void check_finite(const Axis& axis, const Options& curve) {
  for (const Chain& chain : axis.chains) {
    for (const AxisNode& node : chain) {
      if (node.position.allFinite() && node.triad.allFinite() && std::isfinite(node.span)) continue;
      throw InputError(curve.where(), "the length of the axis is beyond the range of numbers");
    }
  }
}

// Joins a chain to the one before it: `slave` is its first node.
void link_corner(int master, int slave, model::Model& model, model::Structure& structure) {
  const std::size_t corner = structure.sets["corners"].size();
  model.add_rigid_link(fmt::format("{}, corner {}", structure.name, corner), slave, master);
}

// Lets nodes of a rigid beam follow its first one.
void link_all(const std::vector<int>& nodes, model::Model& model,
              const model::Structure& structure) {
  const int first = structure.nodes.front();
  for (int node : nodes) {
    if (node != first) model.add_rigid_link(structure.name + ", rigid", node, first);
  }
}

// Adds the nodes of a chain, and its elements, the last ones of the structure so far.
void number_as_in_deck(int refinement, const std::vector<int>& nodes, model::Structure& structure) {
  for (std::size_t i = 0; i < nodes.size(); i += static_cast<std::size_t>(refinement)) {
    structure.deck.nodes.push_back(nodes[i]);
  }
  auto cell = static_cast<int>(structure.deck.cells.size()) * refinement;
  while (cell < static_cast<int>(structure.cells.size())) {
    std::vector<int>& parts = structure.deck.cells.emplace_back();
    for (int part = 0; part < refinement; ++part) parts.push_back(cell++);
  }
}

// How many nodes the axis will have, for a budget before there are any.
double count_nodes(const Options& curve, const Density& density) {
  const std::string& type = curve.text("Type");
  if (type == "Nodes") {
    return static_cast<double>(curve.numbers("Positions").size()) / 3.0 * density.refinement;
  }
  double elements = 0.0;
  if (type == "Polyline") {
    const std::vector<int>& each = curve.integers("Elements");
    const double segments = static_cast<double>(curve.numbers("Points").size()) / 3.0 - 1.0;
    elements =
        each.size() == 1 ? each[0] * segments : std::accumulate(each.begin(), each.end(), 0.0);
  } else {
    elements = curve.integer("Elements");
  }
  return elements * density.intervals();
}

void check_yielding(const ElementFamily& family, const SectionTable& sections,
                    const Options& options) {
  if (!sections.yields() || family.yields || family.fidelity == "Rigid") return;
  throw InputError(options.where(),
                   "its sections yield ('Plasticity'): take 'Element' = 'Director' with 'Fidelity' "
                   "= 'Full' or 'Linear', and leave 'Torsion' out");
}

void check_turn(const ElementFamily& family, double turn, const Options& options) {
  if (turn < family.most_turn) return;
  throw InputError(options.list("Curve").where(),
                   fmt::format("the ends of an element are turned by {:.3g} rad against each "
                               "other; '{}' elements need less than {:g}: take more elements",
                               turn, family.element, family.most_turn));
}

}  // namespace

Schema beam_schema() {
  const ElementFamilies families;
  Schema schema("Beam", "Geometrically exact beam along an axis.");
  add_section_fields(schema);
  schema
      .add(choice("Element", families.elements(),
                  "Director: positions and directors are interpolated. Helical: two nodes, exact "
                  "for constant strain.")
               .optional("Director"))
      .add(
          integer("Order",
                  "Order of interpolation of director elements: nodes of an element minus one. "
                  "`Elements` counts elements of this order, N of them have N * `Order` + 1 nodes.")
              .between(1, 3)
              .optional(2))
      .add(
          choice("Fidelity", families.fidelities(),
                 "Full: geometrically exact. Kirchhoff: without shear and extension. Linear: small "
                 "displacements seen from the first node, which may move at will. Rigid: all nodes "
                 "follow the first one.")
              .optional("Full"))
      .add(
          flag(
              "Torsion",
              "Whether the beam twists; false holds its twist by constraints (Full and Kirchhoff).")
              .optional(true))
      .add(number("Dissipation", "1",
                  "Numerical dissipation of strains in dynamics: 0 keeps the energy, 1 damps most; "
                  "momenta are kept.")
               .between(0.0, 1.0)
               .optional(0.0))
      .add(
          number("Velocity Dissipation", "1",
                 "Numerical dissipation of velocities in dynamics, rigid motions excepted: 0 keeps "
                 "the energy, 1 damps most; momenta are kept.")
              .between(0.0, 1.0)
              .optional(0.0))
      .add(number("Damping", "s", "Physical damping: time by which stress runs ahead of strain.")
               .non_negative()
               .optional(0.0))
      .add(
          numbers("Strain Damping", "s",
                  "The same for (shear 1, shear 2, stretch, curvature 1, curvature 2, twist) each, "
                  "on top of 'Damping'; none without it.")
              .non_negative()
              .optional(std::vector<double>{}))
      .list("Relaxation", relaxation_schema(6), Presence::defaulted)
      .list_by_type("Curve", axes().variants())
      .check([families](const Options& beam, InputIssues& issues) {
        check_choice(families, beam, issues);
        const std::size_t factors = beam.numbers("Strain Damping").size();
        if (factors != 0 && factors != 6) {
          issues.add(beam.where("Strain Damping"),
                     fmt::format("must have six values, got {}", factors));
        }
        const ElementFamily* family = find_family(families, beam);
        if (family == nullptr || family->damps_strains) return;
        const std::string needed = fmt::format(
            "needs elements whose strains are damped one by one, got '{}'", family->element);
        if (factors != 0) issues.add(beam.where("Strain Damping"), needed);
        const Options& relaxation = beam.list("Relaxation");
        if (!relaxation.entries().empty()) issues.add(relaxation.where(), needed);
      });
  return schema;
}

void add_beam(const Options& options, structure::StructureContext& context) {
  const ElementFamilies families;
  const ElementFamily* family = find_family(families, options);
  internal_check(family != nullptr, "the schema refuses beams without a family of elements");
  const bool is_rigid = family->fidelity == "Rigid";
  const model::StrainDamping damping{options.number("Dissipation"), options.number("Damping"),
                                     options.numbers("Strain Damping"),
                                     read_relaxation(options.list("Relaxation"), 6)};
  const SectionTable sections = read_sections(options, context.sections);
  check_yielding(*family, sections, options);
  const Options& curve = options.list("Curve");
  const Density density{family->order, context.refinement};
  if (context.budget != nullptr) {
    const double nodes = count_nodes(curve, density);
    context.budget->take_beam(nodes / density.order, nodes, curve.where());
  }
  Axis axis = axes().make(curve.text("Type"), curve, density);
  check_finite(axis, curve);
  if (context.imperfection != nullptr) deviate(*context.imperfection, options.name(), axis);

  model::Structure& structure = context.model.add_structure(options.name());
  double largest_turn = 0.0;
  for (const Chain& chain : axis.chains) {
    const int before = structure.nodes.empty() ? -1 : structure.nodes.back();
    const std::vector<int> nodes = add_nodes(chain, sections, context.model, structure);
    if (before >= 0) structure.sets["corners"].push_back(before);
    if (is_rigid) {
      link_all(nodes, context.model, structure);
    } else if (before >= 0) {
      link_corner(before, nodes.front(), context.model, structure);
    }
    largest_turn = std::max(
        largest_turn, family->add({chain, nodes, sections, damping, context.model, structure}));
    if (density.refinement > 1) number_as_in_deck(density.refinement, nodes, structure);
  }
  if (!structure.outlines.empty()) structure.outlines.resize(structure.nodes.size());
  structure.sets["first"] = {structure.nodes.front()};
  structure.sets["last"] = {structure.nodes.back()};
  structure.sets["all"] = structure.nodes;
  const double velocity_dissipation = options.number("Velocity Dissipation");
  if (velocity_dissipation > 0.0 && !is_rigid) {
    model::VelocityDissipation::of(context.model).add_body(structure.nodes, velocity_dissipation);
  }
  check_turn(*family, largest_turn, options);
}

}  // namespace culm::beam
