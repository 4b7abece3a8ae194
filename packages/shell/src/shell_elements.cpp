#include "shell_elements.hpp"

#include <culm/shell/elastic_shell.hpp>
#include <culm/shell/element_batches.hpp>
#include <culm/shell/hyperelastic_shell.hpp>
#include <culm/shell/linear_shell.hpp>
#include <culm/shell/shell_mass.hpp>

#include "shell_frame.hpp"
#include "shell_layers.hpp"
#include "yielding_layers.hpp"

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>
#include <variant>

namespace culm::shell {
namespace {

int parameters(const std::string& choice) { return choice == "None" ? 0 : std::stoi(choice); }

std::array<int, 4> nodes_of(const ShellMesh& mesh, std::size_t number,
                            const model::Structure& structure) {
  std::array<int, 4> nodes{};
  for (std::size_t a = 0; a < 4; ++a) {
    nodes[a] = structure.nodes[static_cast<std::size_t>(mesh.quads[number][a])];
  }
  return nodes;
}

// The mass of all elements, on the slots (x, d1, d2, d3) of a node at `centre` that all nodes
// follow, with directors along the axes of space: x = x0 + sum_k X_k d_k, d = sum_k D_k d_k.
SlotMatrix<4> rigid_mass(const ShellMesh& mesh, const material::Layup& layup,
                         const ShellOptions& choice, const Vec3& centre) {
  SlotMatrix<4> mass = SlotMatrix<4>::Zero();
  for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
    const ShellForms::Nodes q = mesh.slots(static_cast<int>(e));
    Mat<8, 4> follow = Mat<8, 4>::Zero();
    for (int a = 0; a < 4; ++a) {
      follow(2 * a, 0) = 1.0;
      follow.row(2 * a).tail<3>() = (q.col(2 * a) - centre).transpose();
      follow.row(2 * a + 1).tail<3>() = q.col(2 * a + 1).transpose();
    }
    mass += follow.transpose() * shell_mass(ShellGeometry(q, layup, choice), layup) * follow;
  }
  return mass;
}

// A node with the mass of all, which all others follow. Elements are not there; their faces are,
// for loads and pictures.
void add_rigid(const ShellMesh& mesh, const SlotMatrix<4>& mass, const Vec3& centre,
               double thickness, model::Structure& structure, model::Model& model) {
  for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
    const std::array<int, 4> nodes = nodes_of(mesh, e, structure);
    structure.cells.push_back({{nodes.begin(), nodes.end()}, nullptr, 0});
    structure.faces.push_back({nodes, thickness});
  }
  model::NodeSlots slots;
  slots << centre, Mat3::Identity();
  const int body = model.nodes().add(slots);
  if (mass(0, 0) > 0.0) model.masses("Rigid shells").add(body, mass);
  for (int node : structure.nodes) model.add_rigid_link(structure.name + ", rigid", node, body);
  structure.body = body;
  model::Structure& shown = model.add_structure(structure.name + " body");
  shown.nodes = {body};
  shown.sets = {{"first", {body}}, {"last", {body}}, {"all", {body}}};
  shown.cells.push_back({{body}, nullptr, 0});
}

Vec3 centre_of(const ShellMesh& mesh) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& x : mesh.positions) sum += x;
  return sum / static_cast<double>(mesh.positions.size());
}

// Layers agree in it, but for branches, whose stiffnesses elements know.
template <class E>
model::StrainDamping damping_of(const material::Layup& layup, const Options& options) {
  const material::Material& material = layup.layers.front().material;
  model::StrainDamping damping{material.dissipation, material.damping, {}};
  for (double time : layup.relaxation_times()) damping.branches.push_back({time, {}});
  if (!model::HasBranchStiffness<E> && !damping.branches.empty()) {
    throw InputError(options.where(),
                     "its material relaxes, which needs a law that is linear in the strains");
  }
  return damping;
}

// What 'Shear Correction' would add to the flexibility in transverse shear. Laws of large strains
// have no such factors; and where a layer has next to no stiffness in shear, somebody has left it
// out by hand and settled the matter.
Vec<2> left_out(const material::Layup& layup, const Options& options) {
  constexpr double by_hand = 1e-4;
  if (options.text("Shear Correction") != "None" || !layup.is_linear()) return Vec<2>::Zero();
  for (const material::Layer& layer : layup.layers) {
    const Mat6& C = std::get<material::StVenantKirchhoff>(layer.material.law).C;
    if (std::min(C(3, 3), C(4, 4)) < by_hand * std::max(C(0, 0), C(1, 1))) return Vec<2>::Zero();
  }
  return material::shear_factors(layup).cwiseInverse() - Vec<2>::Ones();
}

ShellForms::Nodes reference_of(const std::array<int, 4>& nodes, const model::NodeTable& table) {
  ShellForms::Nodes slots;
  for (int a = 0; a < 4; ++a) {
    slots.middleCols<2>(2 * a) =
        model::NodeTable::slots(table.reference(), nodes[index(a)]).leftCols<2>();
  }
  return slots;
}

// Adds the elements of a mesh to a batch, and to the structure what shows them. @return the items
template <class E>
std::vector<int> add_series(model::ElementSeries<E> series, const ShellMesh& mesh, double thickness,
                            model::ElementBatch<E>& batch, model::Structure& structure) {
  const int first = batch.add(std::move(series));
  std::vector<int> items;
  for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
    const std::array<int, 4> nodes = nodes_of(mesh, e, structure);
    items.push_back(first + static_cast<int>(e));
    structure.cells.push_back({{nodes.begin(), nodes.end()}, &batch, items.back()});
    structure.faces.push_back({nodes, thickness});
  }
  return items;
}

template <class E>
void add_full(const std::string& effect, const ShellMesh& mesh,
              const std::shared_ptr<const material::Layup>& layup, const Options& options,
              model::Structure& structure, model::Model& model) {
  const ShellOptions choice = read_options(options);
  auto& batch = model::elements<E>(model, effect, damping_of<E>(*layup, options));
  model::ElementSeries<E> series;
  for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
    series.nodes.push_back(nodes_of(mesh, e, structure));
  }
  const model::NodeTable& table = model.nodes();
  series.make = [&table, layup, choice](const std::array<int, 4>& nodes, int) {
    return E(reference_of(nodes, table), layup, choice);
  };
  series.mass = [&table, layup, choice](const std::array<int, 4>& nodes, int) {
    return shell_mass(ShellGeometry(reference_of(nodes, table), *layup, choice), *layup);
  };
  std::vector<int> items =
      add_series(std::move(series), mesh, layup->thickness(), batch, structure);
  if constexpr (std::is_same_v<E, ElasticShell>) {
    if (yields(*layup)) add_yielding_layers(batch, items, structure.name, model);
  }
  structure.layers =
      std::make_shared<ShellLayers<E>>(batch, std::move(items), layup, left_out(*layup, options));
}

// Elements that all see one frame besides their own nodes.
void add_linear(const ShellMesh& mesh, const std::shared_ptr<const material::Layup>& layup,
                const Options& options, model::Structure& structure, model::Model& model) {
  const ShellOptions choice = read_options(options);
  auto& batch = model::elements<LinearShell>(model, "Shell, linear",
                                             damping_of<LinearShell>(*layup, options));
  const int frame = add_frame(structure.name, structure.nodes, model);
  model::ElementSeries<LinearShell> series;
  for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
    const std::array<int, 4> nodes = nodes_of(mesh, e, structure);
    series.nodes.push_back({frame, nodes[0], nodes[1], nodes[2], nodes[3]});
  }
  const model::NodeTable& table = model.nodes();
  series.make = [&table, layup, choice](const std::array<int, 5>& nodes, int) {
    LinearShell::Nodes reference;
    for (int a = 0; a < 5; ++a) {
      reference.middleCols<4>(4 * a) = model::NodeTable::slots(table.reference(), nodes[index(a)]);
    }
    const ShellForms::Nodes of_wall = reference_of({nodes[1], nodes[2], nodes[3], nodes[4]}, table);
    return LinearShell(ElasticShell(of_wall, layup, choice), reference);
  };
  std::vector<int> items =
      add_series(std::move(series), mesh, layup->thickness(), batch, structure);
  structure.layers = std::make_shared<ShellLayers<LinearShell>>(batch, std::move(items), layup,
                                                                left_out(*layup, options));
}

}  // namespace

ShellOptions read_options(const Options& options) {
  ShellOptions result;
  result.assumed_shear = result.assumed_thickness = options.flag("Assumed Strains");
  result.enhancement = {parameters(options.text("Enhanced Membrane")),
                        parameters(options.text("Enhanced Thickness"))};
  if (options.has("Reference Axis")) {
    result.reference_axis = Eigen::Map<const Vec3>(options.numbers("Reference Axis").data());
  }
  return result;
}

void add_elements(const ShellMesh& mesh, const std::shared_ptr<const material::Layup>& layup,
                  const Options& options, model::Structure& structure, model::Model& model) {
  const std::string& fidelity = options.text("Fidelity");
  if (fidelity == "Rigid") {
    const Vec3 centre = centre_of(mesh);
    add_rigid(mesh, rigid_mass(mesh, *layup, read_options(options), centre), centre,
              layup->thickness(), structure, model);
  } else if (fidelity == "Linear") {
    add_linear(mesh, layup, options, structure, model);
  } else if (layup->is_linear()) {
    add_full<ElasticShell>("Shell", mesh, layup, options, structure, model);
  } else {
    add_full<HyperelasticShell>("Shell, hyperelastic", mesh, layup, options, structure, model);
  }
}

}  // namespace culm::shell
