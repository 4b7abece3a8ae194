#include <culm/joint/shell_connection.hpp>
#include <culm/shell/mesh_types.hpp>
#include <culm/shell/shell_structure.hpp>
#include <culm/shell/subdivision.hpp>

#include "shell_elements.hpp"
#include "yielding_layers.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace culm::shell {

namespace {

constexpr double degree = 0.017453292519943295;

// Beyond these, elements still work but are poor.
constexpr double poor_aspect = 20.0;
constexpr double poor_angle = 20.0 * degree;
constexpr double notable_volume = 0.02;  // that is missing
constexpr double little_volume = 0.01;
// Thickness over size below which rounding shows in bending: a pinched hemisphere is off by 1e-6 at
// 2e-6, 4e-4 at 6e-7 and 1 % at 2e-7; a cantilever by 4e-11 at 1e-6, and fails at 1e-7.
constexpr double thinnest = 1e-6;
// Folds below this may be curved surfaces with few elements.
constexpr double flat_fold = 50.0 * degree;

MeshRegistry meshes() {
  MeshRegistry registry;
  register_meshes(registry);
  return registry;
}

// Says what is poor about a mesh, names what is wrong.
void check_quality(const ShellMesh& mesh, const Options& options, const Log& log) {
  const MeshQuality quality = mesh_quality(mesh);
  const std::string where = to_string(options.where());
  log.info(
      fmt::format("{}: {} nodes, {} elements, aspect up to {:.3g}, angles {:.0f} to {:.0f} "
                  "degrees, warp up to {:.2g} degrees, {} folds at {} places",
                  options.name(), mesh.size(), mesh.quads.size(), quality.largest_aspect,
                  quality.smallest_angle / degree, quality.largest_angle / degree,
                  quality.largest_warp / degree, mesh.fold_lines, mesh.folds.size()));
  if (mesh.fold_lines > 0 && mesh.smallest_fold_angle < flat_fold) {
    log.info(
        fmt::format("{}: folds of only {:.0f} degrees; if a curved surface is meant, use smaller "
                    "elements or a larger 'Fold Angle'",
                    options.name(), mesh.smallest_fold_angle / degree));
  }
  if (!mesh.turned.empty()) {
    log.warning(
        fmt::format("{}: the normals of {} elements, {} the first of them, are on the other side "
                    "than that of a neighbour: pressure, offsets and the order of layers change "
                    "sides there",
                    where, mesh.turned.size(), mesh.turned.front()));
  }
  if (quality.missing_volume > notable_volume) {
    log.warning(fmt::format(
        "{}: flat elements on a curved surface leave the wall about {:.2g} % less volume than it "
        "has, and as much less mass and weight; take {:.2g} times as many elements along the "
        "curves ({:g} %)",
        where, 100.0 * quality.missing_volume, std::sqrt(quality.missing_volume / little_volume),
        100.0 * little_volume));
  }
  if (quality.largest_aspect > poor_aspect || quality.smallest_angle < poor_angle) {
    log.warning(
        fmt::format("{}: elements with an aspect of {:.3g} or an angle of {:.0f} degrees "
                    "are poor",
                    where, quality.largest_aspect, quality.smallest_angle / degree));
  }
}

// Of the stiffness of a wall, bending is the part (t / L)^2. Coordinates of the size L are rounded
// to 1e-16 of it, and forces with the stiffness of the membrane.
void check_thickness(const ShellMesh& mesh, double thickness, const Options& options,
                     const Log& log) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : mesh.positions) box.extend(x);
  const double size = box.diagonal().norm();
  if (thickness >= thinnest * size) return;
  log.warning(fmt::format(
      "{}: the wall is {:.2g} m thick and the shell {:.3g} m large: bending is {:.1g} of its "
      "stiffness, which rounding hides; deflections may be wrong by per cents, or steps fail, "
      "below a thickness of {:g} of the size",
      to_string(options.where()), thickness, size, std::pow(thickness / size, 2), thinnest));
}

std::vector<int> add_nodes(const ShellMesh& mesh, model::Model& model) {
  std::vector<int> numbers;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    model::NodeSlots slots = model::NodeSlots::Zero();
    slots.col(0) = mesh.positions[i];
    slots.col(1) = mesh.directors[i];
    numbers.push_back(model.nodes().add(slots, NodeKind::node6));
  }
  return numbers;
}

// Two Gauss points on each side along an edge.
std::vector<model::LinePoint> line_points(const std::vector<std::array<int, 2>>& sides,
                                          const ShellMesh& mesh, const std::vector<int>& nodes) {
  std::vector<model::LinePoint> points;
  for (const auto& [from, to] : sides) {
    const double length = (mesh.positions[index(to)] - mesh.positions[index(from)]).norm();
    for (double xi : {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)}) {
      points.push_back(
          {{{nodes[index(from)], nodes[index(to)]}, {1.0 - xi, xi}, Vec3::Zero()}, 0.5 * length});
    }
  }
  return points;
}

void add_sets(const ShellMesh& mesh, const std::vector<int>& nodes, model::Structure& structure) {
  for (const auto& [name, edge] : mesh.edges) {
    std::vector<int>& set = structure.sets[name];
    for (int node : edge) set.push_back(nodes[static_cast<std::size_t>(node)]);
    const auto sides = mesh.sides.find(name);
    structure.edges[name] = sides == mesh.sides.end() ? std::vector<model::LinePoint>{}
                                                      : line_points(sides->second, mesh, nodes);
  }
  // where two edges meet: "u0 v0"
  const auto edges = structure.sets;
  for (const auto& [first, one] : edges) {
    for (const auto& [second, other] : edges) {
      if (first >= second) continue;
      std::vector<int> common;
      for (int node : one) {
        if (std::find(other.begin(), other.end(), node) != other.end()) common.push_back(node);
      }
      // a group of the mesh that has this name keeps it
      if (!common.empty()) structure.sets.try_emplace(first + " " + second, common);
    }
  }
  structure.sets["all"] = structure.nodes;
  structure.parts = mesh.parts;
}

// Normals that point to opposite sides: corners out of order, or a quadrilateral bent double.
bool is_crossed(const ShellMesh& mesh, const std::array<int, 4>& quad) {
  std::array<Vec3, 4> points;
  for (std::size_t a = 0; a < 4; ++a) {
    points[a] = mesh.positions[static_cast<std::size_t>(quad[a])];
  }
  const std::array<Vec3, 4> normals = corner_normals(points);
  return std::any_of(normals.begin(), normals.end(),
                     [&](const Vec3& n) { return n.dot(normals[0]) <= 0.0; });
}

// Names the first element that cannot be.
void check_elements(const ShellMesh& mesh, const material::Layup& layup, const ShellOptions& choice,
                    const Options& options) {
  for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
    auto mistakes = shell_mistakes(mesh.slots(static_cast<int>(e)), layup.thickness(), choice);
    if (is_crossed(mesh, mesh.quads[e])) {
      mistakes.emplace_back("its corners are out of order, or it is bent double");
    }
    if (mistakes.empty()) continue;
    throw InputError(options.where(), fmt::format("element {}: {}", e, mistakes.front()));
  }
}

// Walls that meet keep their place and their angle: one joint from each node of a fold to the next.
void join_folds(const ShellMesh& mesh, const std::vector<int>& nodes, const std::string& structure,
                model::Model& model) {
  for (const std::vector<int>& fold : mesh.folds) {
    for (std::size_t i = 0; i + 1 < fold.size(); ++i) {
      const int first = nodes[static_cast<std::size_t>(fold[i])];
      const int second = nodes[static_cast<std::size_t>(fold[i + 1])];
      model::Constraint joint = joint::fold_connection(model.nodes(), first, second);
      joint.type = "Fold";
      joint.is_structural = true;
      joint.name = structure + ", fold";
      model.add_constraint(std::move(joint));
    }
  }
}

// Moves the nodes of a mesh and tilts its directors; the wall keeps its thickness.
void deviate(const model::Imperfection& imperfection, const std::string& name, ShellMesh& mesh) {
  const std::vector<Vec6>& motions = imperfection.of(name, mesh.positions.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    mesh.positions[i] += motions[i].head<3>();
    mesh.directors[i] = (mesh.directors[i] + motions[i].tail<3>()).normalized();
  }
}

// A node of the mesh of the deck is, of the nodes in its elements, the one at its place; so both
// sides of a fold find their own.
model::DeckNumbers number_as_in_deck(const ShellMesh& coarse, const ShellMesh& fine,
                                     const std::vector<int>& parents,
                                     const std::vector<int>& nodes) {
  model::DeckNumbers deck;
  deck.cells.resize(coarse.quads.size());
  deck.nodes.resize(coarse.positions.size(), -1);
  std::vector<double> distance(coarse.positions.size(), std::numeric_limits<double>::max());
  for (std::size_t q = 0; q < fine.quads.size(); ++q) {
    const auto parent = static_cast<std::size_t>(parents[q]);
    deck.cells[parent].push_back(static_cast<int>(q));
    for (int corner : coarse.quads[parent]) {
      const auto c = static_cast<std::size_t>(corner);
      for (int node : fine.quads[q]) {
        const auto n = static_cast<std::size_t>(node);
        const double away = (fine.positions[n] - coarse.positions[c]).norm();
        if (away >= distance[c]) continue;
        distance[c] = away;
        deck.nodes[c] = nodes[n];
      }
    }
  }
  return deck;
}

// Of a mesh before it is made; of one from a file once it is read.
void take_from_budget(const structure::StructureContext& context, const FacetCount& count,
                      const material::Layup& layup, const Options& mesh) {
  if (context.budget == nullptr) return;
  const double n = context.refinement;
  context.budget->take_shell(count.all * n * n, static_cast<double>(layup.layers.size()),
                             count.narrow * n, mesh.where());
}

}  // namespace

Schema shell_schema() {
  Schema schema("Shell", "Solid-degenerate shell of one or more layers on a surface.");
  schema.add_all(material::layup_schema())
      .add(numbers("Reference Axis", "1",
                   "Vector whose projection on the surface is the axis 1 of materials and "
                   "resultants; the first line of each element if absent.")
               .size(3)
               .optional())
      .add(choice("Enhanced Membrane", {"None", "4", "7"},
                  "Parameters of the enhanced membrane strain.")
               .optional("4"))
      .add(choice("Enhanced Thickness", {"None", "1", "4"},
                  "Parameters of the enhanced thickness strain; without them bending is too stiff "
                  "by Poisson's ratio.")
               .optional("4"))
      .add(flag("Assumed Strains",
                "Transverse shear from the edges and thickness strain from the corners; without "
                "them the element locks, which shows what they are good for.")
               .optional(true))
      .add(choice("Fidelity", {"Full", "Linear", "Rigid"},
                  "Full: all there is. Linear: small displacements seen from a frame that moves "
                  "along at will, added as structure 'NAME frame'; materials must be linear. "
                  "Rigid: mass and inertia only; all nodes follow one that is added at their "
                  "centre, as structure 'NAME body'.")
               .optional("Full"))
      .add(number("Fold Angle", "rad",
                  "Elements whose normals differ by more at a common edge keep their own "
                  "directors there.")
               .between(0.0, 3.1)
               .optional(20.0 * degree))
      .list_by_type("Mesh", meshes().variants());
  return schema;
}

void add_shell(const Options& options, structure::StructureContext& context) {
  const auto layup =
      std::make_shared<const material::Layup>(material::read_layup(options, context.materials));
  if (options.text("Fidelity") == "Linear" && !layup->is_linear()) {
    throw InputError(
        options.where("Fidelity"),
        "'Linear' is for small strains, but a material of this shell is for large ones "
        "(Neo-Hooke): take 'Full' or 'Rigid', or a linear material");
  }
  if (options.text("Fidelity") == "Linear" && yields(*layup)) {
    throw InputError(options.where("Fidelity"),
                     "a material of this shell yields ('Plasticity'): take 'Full' or 'Rigid'");
  }
  const Options& list = options.list("Mesh");
  const MeshRegistry types = meshes();
  const std::string& type = list.text("Type");
  take_from_budget(context, count_facets(list), *layup, list);
  const double fold_angle = options.number("Fold Angle");
  Facets facets = types.make(type, list, 1);
  if (type == "Gmsh") {
    take_from_budget(context, {static_cast<double>(facets.quads.size())}, *layup, list);
  }
  ShellMesh mesh = make_mesh(facets, fold_angle);
  ShellMesh coarse;  // as the deck describes it, if that is not what is built
  if (context.refinement > 1) {
    coarse = std::move(mesh);
    const bool is_known = !facets.parents.empty();
    facets = is_known ? types.make(type, list, context.refinement)
                      : subdivide(facets, coarse, context.refinement);
    mesh = make_mesh(facets, fold_angle);
  }
  if (context.imperfection != nullptr) deviate(*context.imperfection, options.name(), mesh);
  check_quality(mesh, options, context.log);
  if (options.text("Fidelity") != "Rigid") {
    check_thickness(mesh, layup->thickness(), options, context.log);
  }

  model::Structure& structure = context.model.add_structure(options.name());
  structure.nodes = add_nodes(mesh, context.model);
  if (context.refinement > 1) {
    structure.deck = number_as_in_deck(coarse, mesh, facets.parents, structure.nodes);
  }
  check_elements(mesh, *layup, read_options(options), options);
  add_elements(mesh, layup, options, structure, context.model);
  if (options.text("Fidelity") != "Rigid") {
    join_folds(mesh, structure.nodes, structure.name, context.model);
  }
  add_sets(mesh, structure.nodes, structure);
}

void register_shells(structure::StructureRegistry& registry) {
  registry.add("Shell", shell_schema(), add_shell);
}

}  // namespace culm::shell
