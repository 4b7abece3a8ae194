#include <culm/output/skin.hpp>

#include "sample_model.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace culm::output {
namespace {

struct Measure {
  double area = 0.0;
  double volume = 0.0;  // of the space inside; right only if all faces look outward
};

Measure measure(const Skin& skin, const std::vector<Vec3>& points) {
  Measure result;
  for (const Skin::Face& face : skin.faces()) {
    const auto point = [&](std::size_t k) { return points[std::size_t(face.points[k])]; };
    for (std::size_t k = 1; k + 1 < face.points.size(); ++k) {
      const Vec3 normal = (point(k) - point(0)).cross(point(k + 1) - point(0)) / 2.0;
      result.area += normal.norm();
      result.volume += normal.dot(point(0)) / 3.0;
    }
  }
  return result;
}

// A prism over a regular polygon with n corners: all numbers are elementary geometry.
TEST(Skin, StraightTubeHasAreaAndVolumeOfThePrism) {
  const StructureMesh mesh = tube_mesh(5);
  const Skin skin(mesh);
  const Measure m = measure(skin, skin.points(mesh.positions, mesh.triads));
  const double angle = 2.0 * std::numbers::pi / tube_corners;
  const double side = 2.0 * tube_radius * std::sin(angle / 2.0);
  const double section = tube_corners * tube_radius * tube_radius * std::sin(angle) / 2.0;
  EXPECT_NEAR(m.area, tube_corners * side * tube_length + 2.0 * section, 1e-13);
  EXPECT_NEAR(m.volume, section * tube_length, 1e-13);
  EXPECT_EQ(skin.faces().size(), 5U * tube_corners + 2U);
}

// Pappus: the volume of a bent tube is section times length of the centre line.
TEST(Skin, BentTubeKeepsItsVolume) {
  const StructureMesh mesh = tube_mesh(200);
  const StructureState state = tube_state(mesh, 1.5);
  const Skin skin(mesh);
  const double straight = measure(skin, skin.points(mesh.positions, mesh.triads)).volume;
  EXPECT_NEAR(measure(skin, skin.points(state.positions, state.triads)).volume, straight,
              1e-5 * straight);
}

TEST(Skin, LinesWithInnerNodesAreSkinnedFromNodeToNode) {
  StructureMesh mesh = tube_mesh(3);
  const double area = [&] {
    const Skin skin(mesh);
    return measure(skin, skin.points(mesh.positions, mesh.triads)).area;
  }();
  mesh.cells = {{CellType::line, {0, 1, 2, 3}}};
  const Skin skin(mesh);
  EXPECT_NEAR(measure(skin, skin.points(mesh.positions, mesh.triads)).area, area, 1e-13);
}

TEST(Skin, RingsHaveNoCaps) {
  StructureMesh mesh = tube_mesh(4);
  mesh.cells.push_back({CellType::line, {4, 0}});
  EXPECT_EQ(Skin(mesh).faces().size(), 5U * tube_corners);
}

// As where a section ends and another one with an outline of its own begins.
TEST(Skin, LeavesOutLinesBetweenOutlinesOfDifferentNumbersOfCorners) {
  StructureMesh mesh = tube_mesh(3);
  mesh.outlines[2] = mesh.outlines[3] = regular_polygon(6, tube_radius);
  EXPECT_EQ(Skin(mesh).faces().size(), tube_corners + 6U + 2U);  // two of three lines, two ends
}

TEST(Skin, StructuresWithoutOutlinesHaveNone) {
  EXPECT_TRUE(Skin(patch_mesh()).empty());
  EXPECT_TRUE(Skin(body_mesh()).empty());
  StructureMesh mesh = tube_mesh(3);
  mesh.outlines[3].clear();
  const Skin skin(mesh);
  EXPECT_EQ(skin.faces().size(), 2U * tube_corners + 1U);  // two lines, one end
  EXPECT_EQ(skin.points(mesh.positions, mesh.triads).size(), 3U * tube_corners);
}

}  // namespace
}  // namespace culm::output
