#include "fluid_pictures.hpp"

#include <culm/lattice/lattice_load.hpp>
#include <culm/water/morison_load.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace culm::simulation {
namespace {

using lattice::BoundLattice;
using lattice::LatticeLoad;
using lattice::Panelling;
using lattice::Points;

std::vector<const LatticeLoad*> lattices_of(const model::Model& model) {
  std::vector<const LatticeLoad*> lattices;
  for (const model::Batch* batch : model.batches()) {
    if (const auto* load = dynamic_cast<const LatticeLoad*>(batch)) lattices.push_back(load);
  }
  return lattices;
}

// Quadrilaterals between `rows` + 1 lines of points, columns of which belong together.
void add_quads(std::vector<output::Cell>& cells, int rows, int columns, std::size_t first,
               std::size_t line) {
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const auto a = static_cast<int>(first + static_cast<std::size_t>(i) * line) + j;
      const auto b = static_cast<int>(first + static_cast<std::size_t>(i + 1) * line) + j;
      cells.push_back({output::CellType::quad4, {a, a + 1, b + 1, b}});
    }
  }
}

void append(std::vector<Vec3>& places, const Points& points) {
  for (std::size_t i = 0; i < points.size(); ++i) places.push_back(points.at(i));
}

output::StructureMesh panels_mesh(const LatticeLoad& load, const model::Coordinates& q) {
  output::StructureMesh mesh;
  mesh.name = load.effect().title() + ", panels";
  mesh.type = "Panels";
  mesh.directors = output::Directors::none;
  append(mesh.positions, load.grid(q));
  for (const Panelling& s : load.lattice().bound().surfaces()) {
    add_quads(mesh.cells, s.panels.chord, s.panels.span, s.first_point,
              static_cast<std::size_t>(s.panels.span) + 1);
  }
  mesh.node_arrays = {{"force [N]", 3}};
  mesh.cell_arrays = {{"circulation [m^2/s]", {"circulation"}}};
  return mesh;
}

output::StructureState panels_state(const LatticeLoad& load, const model::Coordinates& q) {
  output::StructureState state;
  append(state.positions, load.grid(q));
  std::vector<double> forces;
  for (std::size_t i = 0; i < load.forces().size(); ++i) {
    const Vec3 force = load.forces().at(i);
    forces.insert(forces.end(), force.begin(), force.end());
  }
  const auto& circulation = load.fluid().circulation;
  state.node_values = {std::move(forces)};
  state.cell_values = {{circulation.begin(), circulation.end()}};
  return state;
}

// The trailing edges, then all lines that the wake has or may get.
std::vector<Vec3> wake_places(const LatticeLoad& load, const model::Coordinates& q) {
  const BoundLattice& bound = load.lattice().bound();
  const lattice::Wake& wake = load.fluid().wake;
  std::vector<Vec3> places;
  append(places, bound.edge_points(bound.corners(load.grid(q))));
  append(places, wake.lines());
  const std::size_t edge = bound.num_edge_points();
  for (int row = wake.rows(); row < wake.max_rows(); ++row) {
    for (std::size_t j = 0; j < edge; ++j) places.push_back(places[places.size() - edge]);
  }
  return places;
}

output::StructureMesh wake_mesh(const LatticeLoad& load, const model::Coordinates& q) {
  output::StructureMesh mesh;
  mesh.name = load.effect().title() + ", wake";
  mesh.type = "Wake";
  mesh.directors = output::Directors::none;
  mesh.positions = wake_places(load, q);
  const BoundLattice& bound = load.lattice().bound();
  for (const Panelling& s : bound.surfaces()) {
    add_quads(mesh.cells, load.fluid().wake.max_rows(), s.panels.span, s.first_edge_point,
              bound.num_edge_points());
  }
  mesh.cell_arrays = {{"circulation [m^2/s]", {"circulation"}}, {"age [s]", {"age"}}};
  return mesh;
}

output::StructureState wake_state(const LatticeLoad& load, const model::Coordinates& q) {
  const BoundLattice& bound = load.lattice().bound();
  const lattice::Wake& wake = load.fluid().wake;
  std::vector<double> circulation, ages;
  for (const Panelling& s : bound.surfaces()) {
    for (int row = 0; row < wake.max_rows(); ++row) {
      const bool is_there = row < wake.rows();
      const auto at = static_cast<std::size_t>(row);
      for (int j = 0; j < s.panels.span; ++j) {
        circulation.push_back(is_there ? wake.circulation()[at * bound.num_strips() + s.strip(j)]
                                       : 0.0);
        ages.push_back(is_there ? wake.ages()[at] : 0.0);
      }
    }
  }
  output::StructureState state;
  state.positions = wake_places(load, q);
  state.cell_values = {std::move(circulation), std::move(ages)};
  return state;
}

// A sea that pictures show, by the first load that stands in it.
struct ShownSea {
  const water::Sea* sea;
  std::string title;
};

std::vector<ShownSea> seas_of(const model::Model& model) {
  std::vector<ShownSea> seas;
  for (const model::Batch* batch : model.batches()) {
    const auto* load = dynamic_cast<const water::MorisonLoad*>(batch);
    if (load == nullptr || load->sea().shown() == 0.0) continue;
    const bool is_known = std::ranges::any_of(
        seas, [load](const ShownSea& known) { return known.sea == &load->sea(); });
    if (!is_known) seas.push_back({&load->sea(), batch->effect().title()});
  }
  return seas;
}

constexpr int surface_cells = 48;  // along each side of a sea

// Elevations of the points of the surface, and their places.
std::pair<std::vector<double>, std::vector<Vec3>> surface_of(const water::Sea& sea, double time) {
  const Vec3& up = sea.site().up;
  const Vec3 along = up.unitOrthogonal(), across = up.cross(along);
  std::pair<std::vector<double>, std::vector<Vec3>> points;
  for (int i = 0; i <= surface_cells; ++i) {
    for (int j = 0; j <= surface_cells; ++j) {
      const double x = static_cast<double>(i) / surface_cells - 0.5;
      const double y = static_cast<double>(j) / surface_cells - 0.5;
      const Vec3 still = sea.shown() * (x * along + y * across) + sea.site().level * up;
      points.first.push_back(sea.elevation(still, time));
      points.second.emplace_back(still + points.first.back() * up);
    }
  }
  return points;
}

output::StructureMesh surface_mesh(const ShownSea& shown) {
  output::StructureMesh mesh;
  mesh.name = shown.title + ", surface";
  mesh.type = "Surface";
  mesh.directors = output::Directors::none;
  mesh.positions = surface_of(*shown.sea, 0.0).second;
  add_quads(mesh.cells, surface_cells, surface_cells, 0, surface_cells + 1);
  mesh.node_arrays = {{"elevation [m]", 1}};
  return mesh;
}

output::StructureState surface_state(const ShownSea& shown, double time) {
  auto [elevations, places] = surface_of(*shown.sea, time);
  output::StructureState state;
  state.positions = std::move(places);
  state.node_values = {std::move(elevations)};
  return state;
}

}  // namespace

std::vector<output::StructureMesh> fluid_meshes(const model::Model& model) {
  std::vector<output::StructureMesh> meshes;
  for (const LatticeLoad* load : lattices_of(model)) {
    meshes.push_back(panels_mesh(*load, model.nodes().reference()));
    meshes.push_back(wake_mesh(*load, model.nodes().reference()));
  }
  for (const ShownSea& sea : seas_of(model)) meshes.push_back(surface_mesh(sea));
  return meshes;
}

output::Picture fluid_picture(const model::Model& model, const model::State& at) {
  output::Picture picture;
  for (const LatticeLoad* load : lattices_of(model)) {
    picture.structures.push_back(panels_state(*load, at.next));
    picture.structures.push_back(wake_state(*load, at.next));
  }
  // in statics time is the load level, and the sea is that at time 0
  const double time = at.in_motion ? at.time : 0.0;
  for (const ShownSea& sea : seas_of(model)) picture.structures.push_back(surface_state(sea, time));
  return picture;
}

}  // namespace culm::simulation
