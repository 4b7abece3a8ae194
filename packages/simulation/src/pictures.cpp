#include "pictures.hpp"

#include <culm/model/layer_source.hpp>
#include <culm/parallel/owned_numbers.hpp>

#include "place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace culm::simulation {
namespace {

using model::NodeTable;

void read_nodes(const model::Structure& structure, const model::Coordinates& q,
                std::vector<Vec3>& positions, std::vector<Mat3>& triads) {
  const bool is_shell = !structure.faces.empty();
  positions.reserve(structure.nodes.size());
  triads.reserve(structure.nodes.size());
  for (int node : structure.nodes) {
    const auto slots = NodeTable::slots(q, node);
    positions.emplace_back(slots.col(0));
    triads.emplace_back(slots.rightCols<3>());
    // the one director of a shell node points through the thickness: pictures expect it as d3
    if (is_shell) triads.back().col(2).swap(triads.back().col(0));
  }
}

output::CellType cell_type(std::size_t nodes, bool is_shell) {
  if (is_shell) return output::CellType::quad4;
  return nodes == 1 ? output::CellType::vertex : output::CellType::line;
}

// The entry of the deck: one on many nodes makes a constraint for each of them.
std::string entry_of(const model::Constraint& constraint) {
  const std::string list = "Constraints / ";
  const std::string& path = constraint.where.path;
  return path.starts_with(list) ? path.substr(list.size()) : constraint.name;
}

std::vector<output::HeldNodes> held_nodes(const model::Model& model,
                                          const std::unordered_map<int, int>& number) {
  std::vector<output::HeldNodes> held;
  for (const model::Constraint& constraint : model.constraints()) {
    if (constraint.is_structural) continue;
    const std::string name = entry_of(constraint);
    for (const int node : constraint.nodes) {
      const auto found = number.find(node);
      if (found == number.end()) continue;
      if (held.empty() || held.back().name != name) held.push_back({name, constraint.type, {}});
      held.back().nodes.push_back(found->second);
    }
  }
  return held;
}

output::StructureMesh mesh_of(const model::Structure& structure, const model::Model& model) {
  output::StructureMesh mesh;
  mesh.name = structure.name;
  const bool is_shell = !structure.faces.empty();
  mesh.type = is_shell ? "Shell" : structure.nodes.size() == 1 ? "Body" : "Beam";
  if (is_shell) mesh.directors = output::Directors::single;
  mesh.outlines = structure.outlines;
  read_nodes(structure, model.nodes().reference(), mesh.positions, mesh.triads);
  std::unordered_map<int, int> number;  // of a node within the structure
  for (int node : structure.nodes) number.emplace(node, static_cast<int>(number.size()));
  for (const model::Cell& cell : structure.cells) {
    output::Cell picture;
    picture.type = cell_type(cell.nodes.size(), is_shell);
    for (int node : cell.nodes) picture.nodes.push_back(number.at(node));
    mesh.cells.push_back(picture);
    if (cell.source != nullptr) mesh.resultant_names = cell.source->resultant_names();
  }
  mesh.held = held_nodes(model, number);
  return mesh;
}

std::vector<int> shown_layers(const model::Structure& structure, const LayerSettings& settings) {
  std::vector<int> shown;
  const bool wanted = settings.stresses || settings.strains;
  for (int layer = 0; wanted && structure.layers != nullptr && layer < structure.layers->layers();
       ++layer) {
    const auto& chosen = settings.layers;
    if (chosen.empty() || std::find(chosen.begin(), chosen.end(), layer) != chosen.end()) {
      shown.push_back(layer);
    }
  }
  return shown;
}

std::vector<output::CellArray> layer_arrays(const model::Structure& structure,
                                            const LayerSettings& settings) {
  std::vector<output::CellArray> arrays;
  for (int layer : shown_layers(structure, settings)) {
    for (const char* height : model::layer_heights) {
      const auto add = [&](const char* what) {
        arrays.push_back({fmt::format("{} layer {} {}", what, layer, height),
                          {"11", "22", "33", "23", "13", "12"}});
      };
      if (settings.stresses) add("stress");
      if (settings.strains) add("strain");
    }
  }
  return arrays;
}

// The numbers of those arrays. Collective; on rank 0 only.
std::vector<std::vector<double>> layer_values(const parallel::Comm& comm,
                                              const model::Structure& structure,
                                              const LayerSettings& settings,
                                              const model::Coordinates& q) {
  const std::vector<int> shown = shown_layers(structure, settings);
  std::vector<std::vector<double>> values;
  if (shown.empty()) return values;
  values.resize(layer_arrays(structure, settings).size());
  const std::size_t count = structure.cells.size();
  const auto owns = [&](int cell) { return structure.layers->owns(cell); };
  const auto append = [&](int cell, std::vector<double>& numbers) {
    const std::vector<model::LayerState> states = structure.layers->states(cell, q);
    const auto add = [&](const Vec6& v) { numbers.insert(numbers.end(), v.begin(), v.end()); };
    for (int layer : shown) {
      for (std::size_t height = 0; height < model::layer_heights.size(); ++height) {
        const model::LayerState& state =
            states[static_cast<std::size_t>(layer) * model::layer_heights.size() + height];
        if (settings.stresses) add(state.stress);
        if (settings.strains) add(state.strain);
      }
    }
  };
  // cell after cell, and in each array after array
  const std::vector<double> all =
      parallel::gather_owned(comm, count, 6 * values.size(), owns, append);
  for (std::size_t at = 0; at < all.size(); at += 6) {
    std::vector<double>& array = values[at / 6 % values.size()];
    array.insert(array.end(), all.data() + at, all.data() + at + 6);
  }
  return values;
}

// Stress resultants, cell after cell; empty where there are none. Collective; on rank 0 only.
std::vector<double> resultants_of(const parallel::Comm& comm, const model::Structure& structure,
                                  const model::Coordinates& q) {
  const std::vector<model::Cell>& cells = structure.cells;
  const auto cell_of = [&](int item) -> const model::Cell& {
    return cells[static_cast<std::size_t>(item)];
  };
  std::size_t width = 0;
  for (const model::Cell& cell : cells) {
    if (cell.source != nullptr) width = cell.source->resultant_names().size();
    if (width > 0) break;
  }
  return parallel::gather_owned(
      comm, cells.size(), width,
      [&](int item) {
        const model::Cell& cell = cell_of(item);
        return cell.source != nullptr && cell.source->owns(cell.item);
      },
      [&](int item, std::vector<double>& numbers) {
        cell_of(item).source->resultants(cell_of(item).item, q, numbers);
      });
}

}  // namespace

std::vector<output::StructureMesh> meshes_of(const model::Model& model,
                                             const LayerSettings& layers) {
  std::vector<output::StructureMesh> meshes;
  for (const model::Structure& structure : model.structures()) {
    meshes.push_back(mesh_of(structure, model));
    meshes.back().cell_arrays = layer_arrays(structure, layers);
  }
  return meshes;
}

output::Picture picture_of(const assembly::System& system, const LayerSettings& layers,
                           const model::Coordinates& q) {
  output::Picture picture;
  for (const model::Structure& structure : system.model().structures()) {
    output::StructureState s;
    if (system.comm().is_root()) read_nodes(structure, q, s.positions, s.triads);
    s.resultants = resultants_of(system.comm(), structure, q);
    s.cell_values = layer_values(system.comm(), structure, layers, q);
    picture.structures.push_back(std::move(s));
  }
  return picture;
}

void add_reference(const model::Model& model, output::Picture& picture) {
  for (std::size_t i = 0; i < picture.structures.size(); ++i) {
    output::StructureState& s = picture.structures[i];
    read_nodes(model.structures()[i], model.nodes().reference(), s.reference_positions,
               s.reference_triads);
  }
}

void show_velocities(std::vector<output::StructureMesh>& meshes) {
  for (output::StructureMesh& mesh : meshes) {
    mesh.node_arrays.push_back({"velocity", 3});
    if (mesh.directors == output::Directors::triad) {
      mesh.node_arrays.push_back({"angular velocity", 3});
    }
  }
}

void add_velocities(const model::Model& model, const model::State& state,
                    output::Picture& picture) {
  for (std::size_t i = 0; i < picture.structures.size(); ++i) {
    const model::Structure& structure = model.structures()[i];
    std::vector<double> velocities;
    std::vector<double> spins;
    for (int node : structure.nodes) {
      const Vec3 velocity = Place{.node = node}.seen_velocity(state);
      velocities.insert(velocities.end(), velocity.begin(), velocity.end());
      if (!structure.faces.empty()) continue;
      const Vec3 own = spin(node, state);
      spins.insert(spins.end(), own.begin(), own.end());
    }
    auto& values = picture.structures[i].node_values;
    values.push_back(std::move(velocities));
    if (!spins.empty()) values.push_back(std::move(spins));
  }
}

}  // namespace culm::simulation
