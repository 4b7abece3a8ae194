/// A small model that the tests write: a tube bent in time, a shell patch and a rigid body.
#pragma once

#include <culm/output/picture_mesh.hpp>

#include <culm_kit/temporary_folder.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace culm::output {

using kit::TemporaryFolder;

/// A regular polygon with `corners` points on a circle.
inline std::vector<Eigen::Vector2d> regular_polygon(int corners, double radius) {
  std::vector<Eigen::Vector2d> points;
  for (int j = 0; j < corners; ++j) {
    const double angle = 2.0 * std::numbers::pi * j / corners;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return points;
}

inline constexpr double tube_length = 2.0;
inline constexpr double tube_radius = 0.1;
inline constexpr int tube_corners = 24;

/// Position and triad at arc length s of a line along e3 that is bent by `angle` over its length
/// about e2; the triad is that of the cross-section, d3 along the line.
inline void bent_line(double s, double angle, Vec3& x, Mat3& triad) {
  const double phi = angle * s / tube_length;
  const double radius = angle == 0.0 ? 0.0 : tube_length / angle;
  const double along = angle == 0.0 ? s : radius * std::sin(phi);
  x = {radius * (1.0 - std::cos(phi)), 0.0, along};
  triad << std::cos(phi), 0.0, std::sin(phi), 0.0, 1.0, 0.0, -std::sin(phi), 0.0, std::cos(phi);
}

/// A tube of `elements` beams.
inline StructureMesh tube_mesh(int elements) {
  StructureMesh mesh;
  mesh.name = "main tube";
  mesh.type = "Beam";
  for (int i = 0; i <= elements; ++i) {
    Vec3 x;
    Mat3 triad;
    bent_line(tube_length * i / elements, 0.0, x, triad);
    mesh.positions.push_back(x);
    mesh.triads.push_back(triad);
    mesh.outlines.push_back(regular_polygon(tube_corners, tube_radius));
    if (i < elements) mesh.cells.push_back({CellType::line, {i, i + 1}});
  }
  mesh.resultant_names = {"N1", "N2", "N3", "M1", "M2", "M3"};
  mesh.node_arrays = {{"reaction", 3}, {"temperature", 1}};
  mesh.held = {{"foot", "Rigid Support", {0}}};
  return mesh;
}

inline StructureMesh patch_mesh() {
  StructureMesh mesh;
  mesh.name = "patch";
  mesh.type = "Shell";
  mesh.directors = Directors::single;
  for (const auto& [x, z] : {std::pair{0.5, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.5, 1.0}}) {
    mesh.positions.emplace_back(x, 0.0, z);
    Mat3 triad = Mat3::Zero();
    triad.col(2) = Vec3::UnitY();
    mesh.triads.push_back(triad);
  }
  mesh.cells = {{CellType::quad4, {0, 1, 2, 3}}};
  mesh.resultant_names = {"n11"};
  mesh.cell_arrays = {{"stress", {"11", "22"}}};
  return mesh;
}

inline StructureMesh body_mesh() {
  StructureMesh mesh;
  mesh.name = "hub/left";
  mesh.type = "Rigid Body";
  mesh.positions = {Vec3(0.0, 0.5, 0.0)};
  mesh.triads = {Mat3::Identity()};
  mesh.cells = {{CellType::vertex, {0}}};
  return mesh;
}

inline std::vector<StructureMesh> sample_meshes(int elements = 16) {
  return {tube_mesh(elements), patch_mesh(), body_mesh()};
}

/// The tube bent by `angle`; resultants of cell c are 10 c + (0, ..., 5), the reaction at node n is
/// (n, 0, -n) and the temperature 300 + n.
inline StructureState tube_state(const StructureMesh& mesh, double angle) {
  StructureState state;
  state.node_values.resize(2);
  const int elements = mesh.cell_count();
  for (int i = 0; i <= elements; ++i) {
    Vec3 x;
    Mat3 triad;
    bent_line(tube_length * i / elements, angle, x, triad);
    state.positions.push_back(x);
    state.triads.push_back(triad);
    state.node_values[0].insert(state.node_values[0].end(), {1.0 * i, 0.0, -1.0 * i});
    state.node_values[1].push_back(300.0 + i);
  }
  for (int c = 0; c < elements; ++c) {
    for (int k = 0; k < 6; ++k) state.resultants.push_back(10.0 * c + k);
  }
  return state;
}

/// Step `index` at time index / 10: the tube bent by a quarter of the time, patch and body moved.
inline Picture sample_picture(const std::vector<StructureMesh>& meshes, int index) {
  Picture picture{.index = index, .time = 0.1 * index, .structures = {}, .arrays = {}};
  picture.structures.push_back(tube_state(meshes[0], 2.5 * picture.time));
  StructureState patch{meshes[1].positions, meshes[1].triads, {7.5}, {}, {{1.5, 2.5}}};
  for (Vec3& x : patch.positions) x.y() += picture.time;
  picture.structures.push_back(patch);
  StructureState body{meshes[2].positions, meshes[2].triads, {}, {}};
  body.positions[0].x() -= picture.time;
  picture.structures.push_back(body);
  picture.arrays.push_back({"multipliers", 1, {1.0, 2.0, 3.0}});
  return picture;
}

}  // namespace culm::output
