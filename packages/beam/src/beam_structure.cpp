#include <culm/beam/axis_types.hpp>
#include <culm/beam/beam_elements.hpp>
#include <culm/beam/beam_structure.hpp>
#include <culm/beam/helical_beam.hpp>
#include <culm/math/rotation.hpp>
#include <culm/model/velocity_dissipation.hpp>

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace culm::beam {

namespace {

AxisRegistry axes() {
  AxisRegistry registry;
  register_axes(registry);
  return registry;
}

ElementKind read_kind(const Options& options) {
  if (options.text("Element") == "Helical") return ElementKind::helical;
  switch (options.integer("Order")) {
    case 1:
      return ElementKind::director_1;
    case 2:
      return ElementKind::director_2;
    default:
      return ElementKind::director_3;
  }
}

Fidelity read_fidelity(const Options& options) {
  const std::string& name = options.text("Fidelity");
  if (name == "Kirchhoff") return Fidelity::kirchhoff;
  if (name == "Linear") return Fidelity::linear;
  return name == "Rigid" ? Fidelity::rigid : Fidelity::full;
}

std::vector<int> add_nodes(const Chain& chain, const SectionTable& sections, model::Model& model,
                           model::Structure& structure) {
  std::vector<int> numbers;
  for (const AxisNode& node : chain) {
    model::NodeSlots slots;
    slots << node.position, node.triad;
    numbers.push_back(model.nodes().add(slots));
    structure.outlines.push_back(sections.at(node.span).outline);
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

void check_turn(ElementKind kind, double turn, const Options& options) {
  if (kind == ElementKind::helical && turn >= HelicalBeam::max_rotation) {
    throw InputError(options.list("Curve").where(),
                     fmt::format("the ends of an element are turned by {:.3g} rad against each "
                                 "other; helical elements need less than {:g}: take more elements",
                                 turn, HelicalBeam::max_rotation));
  }
}

}  // namespace

Schema beam_schema() {
  Schema schema("Beam", "Geometrically exact beam along an axis.");
  add_section_fields(schema);
  schema
      .add(choice("Element", {"Director", "Helical"},
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
          choice("Fidelity", {"Full", "Kirchhoff", "Linear", "Rigid"},
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
      .check([](const Options& beam, InputIssues& issues) {
        const bool is_helical = beam.text("Element") == "Helical";
        if (is_helical && beam.given("Order") && beam.integer("Order") != 1) {
          issues.add(beam.where("Order"), "helical elements have two nodes: leave 'Order' out");
        }
        const std::string& fidelity = beam.text("Fidelity");
        if (is_helical && (fidelity == "Kirchhoff" || fidelity == "Linear")) {
          issues.add(beam.where("Fidelity"), "needs director elements, got helical ones");
        }
        if (!beam.flag("Torsion") && (is_helical || fidelity == "Linear" || fidelity == "Rigid")) {
          issues.add(beam.where("Torsion"),
                     "false needs director elements whose 'Fidelity' is Full or Kirchhoff");
        }
        const std::size_t factors = beam.numbers("Strain Damping").size();
        if (factors != 0 && factors != 6) {
          issues.add(beam.where("Strain Damping"),
                     fmt::format("must have six values, got {}", factors));
        } else if (factors == 6 && is_helical) {
          issues.add(beam.where("Strain Damping"), "needs director elements, got helical ones");
        }
        if (is_helical && !beam.list("Relaxation").entries().empty()) {
          issues.add(beam.list("Relaxation").where(), "needs director elements, got helical ones");
        }
      });
  return schema;
}

void add_beam(const Options& options, structure::StructureContext& context) {
  const ElementKind kind = read_kind(options);
  const Fidelity fidelity = read_fidelity(options);
  const bool is_rigid = fidelity == Fidelity::rigid;
  const ElementChoice choice{
      kind,
      fidelity,
      {options.number("Dissipation"), options.number("Damping"), options.numbers("Strain Damping"),
       read_relaxation(options.list("Relaxation"), 6)},
      options.flag("Torsion")};
  const SectionTable sections = read_sections(options, context.sections);
  const Options& curve = options.list("Curve");
  const Density density{order_of(kind), context.refinement};
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
    const ReferenceState reference =
        add_elements(choice, chain, nodes, sections, context.model, structure);
    largest_turn = std::max(largest_turn, reference.largest_turn);
    if (density.refinement > 1) number_as_in_deck(density.refinement, nodes, structure);
  }
  structure.sets["first"] = {structure.nodes.front()};
  structure.sets["last"] = {structure.nodes.back()};
  structure.sets["all"] = structure.nodes;
  const double velocity_dissipation = options.number("Velocity Dissipation");
  if (velocity_dissipation > 0.0 && !is_rigid) {
    model::VelocityDissipation::of(context.model).add_body(structure.nodes, velocity_dissipation);
  }
  if (!is_rigid) check_turn(kind, largest_turn, options);
}

}  // namespace culm::beam
