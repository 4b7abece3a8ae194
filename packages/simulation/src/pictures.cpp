#include "pictures.hpp"

#include <culm/model/layer_source.hpp>
#include <culm/parallel/owned_numbers.hpp>

#include "place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <unordered_map>
#include <utility>

namespace culm::simulation {
namespace {

using model::NodeTable;

// Those that a rank has, by their numbers.
template <class Action>
void each_row(const RowRanges& rows, const Action& action) {
  for (const RowRange& range : rows) {
    for (std::size_t i = 0; i < range.count; ++i) action(range.first + i);
  }
}

RowRanges all_rows(std::size_t count) { return count == 0 ? RowRanges() : RowRanges{{0, count}}; }

void read_nodes(const model::Structure& structure, const RowRanges& rows,
                const model::Coordinates& q, std::vector<Vec3>& positions,
                std::vector<Mat3>& triads) {
  const bool is_shell = !structure.faces.empty();
  positions.reserve(count_rows(rows));
  triads.reserve(count_rows(rows));
  each_row(rows, [&](std::size_t row) {
    const auto slots = NodeTable::slots(q, structure.nodes[row]);
    positions.emplace_back(slots.col(0));
    triads.emplace_back(slots.rightCols<3>());
    // the one director of a shell node points through the thickness: pictures expect it as d3
    if (is_shell) triads.back().col(2).swap(triads.back().col(0));
  });
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

// A node as one of a structure.
struct NodePlace {
  int node = 0;
  std::size_t structure = 0;
  int number = 0;  // within the structure

  auto operator<=>(const NodePlace&) const = default;
};

std::vector<NodePlace> places_by_node(const model::Model& model) {
  std::vector<NodePlace> places;
  for (std::size_t s = 0; s < model.structures().size(); ++s) {
    int number = 0;
    for (const int node : model.structures()[s].nodes) places.push_back({node, s, number++});
  }
  std::ranges::sort(places);
  return places;
}

// Adds to the structures what holds their nodes.
void add_held_nodes(const model::Model& model, std::vector<output::StructureMesh>& meshes) {
  const std::vector<NodePlace> places = places_by_node(model);
  for (const model::Constraint& constraint : model.constraints()) {
    if (constraint.is_structural) continue;
    const std::string name = entry_of(constraint);
    for (const int node : constraint.nodes) {
      for (const NodePlace& place : std::ranges::equal_range(places, node, {}, &NodePlace::node)) {
        std::vector<output::HeldNodes>& held = meshes[place.structure].held;
        if (held.empty() || held.back().name != name) held.push_back({name, constraint.type, {}});
        held.back().nodes.push_back(place.number);
      }
    }
  }
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

// The numbers of those arrays.
std::vector<std::vector<double>> layer_values(const model::Structure& structure,
                                              const RowRanges& cells, const LayerSettings& settings,
                                              const model::Coordinates& q) {
  const std::vector<int> shown = shown_layers(structure, settings);
  std::vector<std::vector<double>> values;
  if (shown.empty()) return values;
  values.resize(layer_arrays(structure, settings).size());
  each_row(cells, [&](std::size_t cell) {
    const std::vector<model::LayerState> states =
        structure.layers->states(static_cast<int>(cell), q);
    auto array = values.begin();
    const auto add = [&](const Vec6& v) {
      array->insert(array->end(), v.begin(), v.end());
      ++array;
    };
    for (int layer : shown) {
      for (std::size_t height = 0; height < model::layer_heights.size(); ++height) {
        const model::LayerState& state =
            states[static_cast<std::size_t>(layer) * model::layer_heights.size() + height];
        if (settings.stresses) add(state.stress);
        if (settings.strains) add(state.strain);
      }
    }
  });
  return values;
}

// Stress resultants, cell after cell; empty where there are none.
std::vector<double> resultants_of(const model::Structure& structure, const RowRanges& rows,
                                  std::size_t width, const model::Coordinates& q) {
  std::vector<double> numbers;
  if (width == 0) return numbers;
  numbers.reserve(width * count_rows(rows));
  each_row(rows, [&](std::size_t row) {
    const model::Cell& cell = structure.cells[row];
    if (cell.source != nullptr) {
      cell.source->resultants(cell.item, q, numbers);
    } else {
      numbers.insert(numbers.end(), width, 0.0);
    }
  });
  return numbers;
}

// What is known of a structure without its nodes and cells.
output::StructureMesh frame_of(const model::Structure& structure, const LayerSettings& layers) {
  output::StructureMesh frame;
  frame.name = structure.name;
  const bool is_shell = !structure.faces.empty();
  frame.type = is_shell ? "Shell" : structure.nodes.size() == 1 ? "Body" : "Beam";
  if (is_shell) frame.directors = output::Directors::single;
  const auto cell = std::ranges::find_if(structure.cells,
                                         [](const model::Cell& c) { return c.source != nullptr; });
  if (cell != structure.cells.end()) frame.resultant_names = (*cell).source->resultant_names();
  frame.cell_arrays = layer_arrays(structure, layers);
  return frame;
}

// Without what holds it.
output::StructureMesh mesh_of(const model::Structure& structure, const LayerSettings& layers,
                              const model::Model& model) {
  output::StructureMesh mesh = frame_of(structure, layers);
  mesh.outlines = structure.outlines;
  read_nodes(structure, all_rows(structure.nodes.size()), model.nodes().reference(), mesh.positions,
             mesh.triads);
  std::unordered_map<int, int> number;  // of a node within the structure
  for (int node : structure.nodes) number.emplace(node, static_cast<int>(number.size()));
  for (const model::Cell& cell : structure.cells) {
    output::Cell picture;
    picture.type = cell_type(cell.nodes.size(), !structure.faces.empty());
    for (int node : cell.nodes) picture.nodes.push_back(number.at(node));
    mesh.cells.push_back(picture);
  }
  return mesh;
}

// Vectors or matrices of all ranks, on rank 0.
template <class Matrix>
std::vector<Matrix> gather_each(const parallel::Comm& comm, std::size_t rows, const RowRanges& own,
                                const std::vector<Matrix>& each) {
  if (comm.max(each.empty() ? 0 : 1) == 0) return {};
  constexpr auto width = static_cast<std::size_t>(Matrix::SizeAtCompileTime);
  static_assert(sizeof(Matrix) == width * sizeof(double));
  std::vector<Matrix> whole(comm.is_root() ? rows : 0);
  const auto numbers = [](auto& matrices) {
    auto* const first = matrices.empty() ? nullptr : matrices.front().data();
    return std::span(first, width * matrices.size());
  };
  parallel::gather_rows(comm, width, own, numbers(each), numbers(whole));
  return whole;
}

std::vector<output::StructurePart> parts_of(const assembly::System& system) {
  std::vector<bool> is_own(static_cast<std::size_t>(system.model().nodes().size()), false);
  for (const int node : system.owned_nodes()) is_own[static_cast<std::size_t>(node)] = true;
  std::vector<output::StructurePart> parts;
  for (const model::Structure& structure : system.model().structures()) {
    output::StructurePart& part = parts.emplace_back();
    for (std::size_t row = 0; row < structure.nodes.size(); ++row) {
      if (is_own[static_cast<std::size_t>(structure.nodes[row])]) append_row(part.nodes, row);
    }
    for (std::size_t row = 0; row < structure.cells.size(); ++row) {
      const model::Cell& cell = structure.cells[row];
      const bool is_here =
          cell.source != nullptr ? cell.source->owns(cell.item) : system.comm().is_root();
      if (is_here) append_row(part.cells, row);
    }
  }
  return parts;
}

std::vector<output::StructureMesh> meshes_of_part(const model::Model& drawn,
                                                  const std::vector<output::StructurePart>& rows,
                                                  const LayerSettings& layers, bool velocities) {
  std::vector<output::StructureMesh> meshes;
  for (std::size_t s = 0; s < rows.size(); ++s) {
    const model::Structure& structure = drawn.structures()[s];
    output::StructureMesh& mesh = meshes.emplace_back(frame_of(structure, layers));
    // by which displacements are known; turns are not shown as differences
    each_row(rows[s].nodes, [&](std::size_t row) {
      mesh.positions.emplace_back(
          NodeTable::slots(drawn.nodes().reference(), structure.nodes[row]).col(0));
    });
  }
  if (velocities) show_velocities(meshes);
  return meshes;
}

// Of whole structures, given what a rank has of them.
output::StateTables tables_of(const model::Model& model,
                              const std::vector<output::StructureMesh>& meshes) {
  std::vector<output::StructureFields> structures;
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    structures.push_back(output::fields_of(meshes[s]));
    structures.back().nodes = model.structures()[s].nodes.size();
    structures.back().cells = model.structures()[s].cells.size();
  }
  return output::StateTables(structures);
}

}  // namespace

std::vector<output::StructureMesh> meshes_of(const model::Model& model,
                                             const LayerSettings& layers) {
  std::vector<output::StructureMesh> meshes;
  for (const model::Structure& structure : model.structures()) {
    meshes.push_back(mesh_of(structure, layers, model));
  }
  add_held_nodes(model, meshes);
  return meshes;
}

PicturePart::PicturePart(const assembly::System& system, const model::Model& drawn,
                         const LayerSettings& layers, bool velocities)
    : system_(&system),
      layers_(layers),
      rows_(parts_of(system)),
      meshes_(meshes_of_part(drawn, rows_, layers, velocities)),
      tables_(tables_of(system.model(), meshes_)) {}

output::Picture PicturePart::draw(const model::Coordinates& q) const {
  output::Picture picture;
  for (std::size_t s = 0; s < rows_.size(); ++s) {
    const model::Structure& structure = system_->model().structures()[s];
    output::StructureState& state = picture.structures.emplace_back();
    read_nodes(structure, rows_[s].nodes, q, state.positions, state.triads);
    state.resultants =
        resultants_of(structure, rows_[s].cells, meshes_[s].resultant_names.size(), q);
    state.cell_values = layer_values(structure, rows_[s].cells, layers_, q);
  }
  return picture;
}

output::Picture PicturePart::gather(output::Picture picture) const {
  const parallel::Comm& comm = system_->comm();
  if (comm.size() == 1) return picture;
  for (std::size_t s = 0; s < rows_.size(); ++s) {
    const model::Structure& structure = system_->model().structures()[s];
    const output::StructureMesh& mesh = meshes_[s];
    output::StructureState& state = picture.structures[s];
    const std::size_t nodes = structure.nodes.size();
    const auto each_node = [&](auto& each) {
      each = gather_each(comm, nodes, rows_[s].nodes, each);
    };
    each_node(state.positions);
    each_node(state.triads);
    each_node(state.reference_positions);
    each_node(state.reference_triads);
    const auto rows = [&](std::size_t count, const RowRanges& own, std::size_t width,
                          std::vector<double>& numbers) {
      numbers = parallel::gather_rows(comm, count, width, own, std::move(numbers));
    };
    for (std::size_t a = 0; a < mesh.node_arrays.size(); ++a) {
      rows(nodes, rows_[s].nodes, static_cast<std::size_t>(mesh.node_arrays[a].columns),
           state.node_values[a]);
    }
    const std::size_t cells = structure.cells.size();
    rows(cells, rows_[s].cells, mesh.resultant_names.size(), state.resultants);
    for (std::size_t a = 0; a < mesh.cell_arrays.size(); ++a) {
      rows(cells, rows_[s].cells, mesh.cell_arrays[a].columns.size(), state.cell_values[a]);
    }
  }
  return picture;
}

output::Picture picture_of(const assembly::System& system, const model::Coordinates& q) {
  const PicturePart part(system, system.model(), {});
  return part.gather(part.draw(q));
}

void PicturePart::add_reference(output::Picture& picture) const {
  for (std::size_t s = 0; s < rows_.size(); ++s) {
    output::StructureState& state = picture.structures[s];
    read_nodes(system_->model().structures()[s], rows_[s].nodes,
               system_->model().nodes().reference(), state.reference_positions,
               state.reference_triads);
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

void PicturePart::add_velocities(const model::State& state, output::Picture& picture) const {
  for (std::size_t s = 0; s < rows_.size(); ++s) {
    const model::Structure& structure = system_->model().structures()[s];
    std::vector<double> velocities;
    std::vector<double> spins;
    each_row(rows_[s].nodes, [&](std::size_t row) {
      const int node = structure.nodes[row];
      const Vec3 velocity = Place{.node = node}.seen_velocity(state);
      velocities.insert(velocities.end(), velocity.begin(), velocity.end());
      if (!structure.faces.empty()) return;
      const Vec3 own = spin(node, state);
      spins.insert(spins.end(), own.begin(), own.end());
    });
    auto& values = picture.structures[s].node_values;
    values.push_back(std::move(velocities));
    if (structure.faces.empty()) values.push_back(std::move(spins));
  }
}

}  // namespace culm::simulation
