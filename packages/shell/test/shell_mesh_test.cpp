#include <culm/shell/shell_geometry.hpp>
#include <culm/shell/subdivision.hpp>
#include <culm/shell/surfaces.hpp>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace culm::shell {
namespace {

using std::numbers::pi;
constexpr double fold = pi / 9.0;  // 20 degrees

double area(const ShellMesh& mesh) {
  double sum = 0.0;
  for (int q = 0; q < static_cast<int>(mesh.quads.size()); ++q) {
    const ShellForms::Nodes x = mesh.slots(q);
    sum += 0.5 * (x.col(4) - x.col(0)).cross(x.col(6) - x.col(2)).norm();
  }
  return sum;
}

// Every element has a positive volume, all normals agree, and all directors have length one.
void expect_sound(const ShellMesh& mesh, double thickness) {
  EXPECT_TRUE(mesh.turned.empty());
  for (int q = 0; q < static_cast<int>(mesh.quads.size()); ++q) {
    EXPECT_EQ(shell_mistakes(mesh.slots(q), thickness), std::vector<std::string>{}) << q;
  }
  for (const Vec3& director : mesh.directors) EXPECT_NEAR(director.norm(), 1.0, 1e-15);
}

double length(const ShellMesh& mesh, const std::string& edge) {
  double sum = 0.0;
  for (const auto& [from, to] : mesh.sides.at(edge)) {
    sum += (mesh.positions[static_cast<std::size_t>(to)] -
            mesh.positions[static_cast<std::size_t>(from)])
               .norm();
  }
  return sum;
}

// Whether an edge closes on itself, or is several that meet.
TEST(ShellMesh, SidesAlongAnEdgeAreAllThereAndOnce) {
  const auto flat = patch(plane(Vec3::Zero(), Vec3(3, 0, 0), Vec3(0, 2, 0)), 3, 2, "plate");
  EXPECT_NEAR(length(make_mesh(flat, fold), "plate u1"), 2.0, 1e-14);
  const auto tube = patch(cylinder(2.0, 5.0), 24, 5, "tube");
  EXPECT_EQ(make_mesh(tube, fold).sides.at("tube v0").size(), 24u);
  EXPECT_NEAR(length(make_mesh(tube, fold), "tube v0"), 24 * 4.0 * std::sin(pi / 24), 1e-12);
  const auto profile = i_section({2.0, 1.0, 1.5}, 10.0, 2, 4, 5);
  EXPECT_NEAR(length(make_mesh(profile, fold), "start"), 4.5, 1e-12);
  for (const Facets& coarse : {flat, tube, profile}) {
    const ShellMesh mesh = make_mesh(coarse, fold);
    const ShellMesh fine = make_mesh(subdivide(coarse, mesh, 3), fold);
    for (const auto& [name, sides] : mesh.sides) {
      EXPECT_EQ(fine.sides.at(name).size(), 3 * sides.size()) << name;
      EXPECT_NEAR(length(fine, name) / length(mesh, name), 1.0, 5e-3) << name;
    }
  }
}

TEST(ShellMesh, PlanePatchHasNamedEdgesInOrder) {
  const ShellMesh mesh =
      make_mesh(patch(plane(Vec3::Zero(), Vec3(3, 0, 0), Vec3(0, 2, 0)), 3, 2, "plate"), fold);
  EXPECT_EQ(mesh.size(), 12);
  EXPECT_EQ(mesh.parts.at("plate").size(), 6u);
  const auto& right = mesh.edges.at("plate u1");
  ASSERT_EQ(right.size(), 3u);
  for (int j = 0; j < 3; ++j) {
    EXPECT_EQ(mesh.positions[static_cast<std::size_t>(right[static_cast<std::size_t>(j)])],
              Vec3(3, j, 0));
  }
  EXPECT_EQ(mesh.edges.at("plate v1").size(), 4u);
  EXPECT_TRUE(mesh.folds.empty());
  EXPECT_NEAR(area(mesh), 6.0, 1e-14);
  expect_sound(mesh, 0.1);
}

TEST(ShellMesh, TubeClosesOnItself) {
  const ShellMesh mesh = make_mesh(patch(cylinder(2.0, 5.0), 24, 5, "tube"), fold);
  EXPECT_EQ(mesh.size(), 24 * 6);
  EXPECT_TRUE(mesh.folds.empty());
  EXPECT_EQ(mesh.edges.at("tube v0").size(), 24u);
  for (std::size_t a = 0; a < mesh.positions.size(); ++a) {
    const Vec3 out(mesh.positions[a].x(), mesh.positions[a].y(), 0.0);
    EXPECT_LT((mesh.directors[a] - out.normalized()).norm(), 1e-14);
  }
  expect_sound(mesh, 0.1);
}

// a coarse polygon, where neighbouring elements meet at 60 degrees: the surface is smooth still
TEST(ShellMesh, SmoothSurfacesHaveNoFoldsHoweverCoarse) {
  EXPECT_TRUE(make_mesh(patch(cylinder(2.0, 5.0), 6, 1, "tube"), fold).folds.empty());
}

TEST(ShellMesh, CurvedPatchesAreSound) {
  const Sweep quarter{0.0, 0.5 * pi};
  const Surface surfaces[] = {sphere(10.0, 0.0, 0.4 * pi, quarter), cone(2.0, 1.0, 4.0, quarter),
                              annulus(1.0, 3.0, quarter), hypar(1.0, 1.0)};
  const double areas[] = {50.0 * pi * std::sin(0.4 * pi), 0.25 * pi * 3.0 * std::sqrt(17.0),
                          2.0 * pi, 1.2807893};
  for (std::size_t i = 0; i < 4; ++i) {
    const ShellMesh mesh = make_mesh(patch(surfaces[i], 32, 32, "patch"), fold);
    EXPECT_EQ(mesh.size(), 33 * 33);
    EXPECT_NEAR(area(mesh) / areas[i], 1.0, 1e-3) << i;
    expect_sound(mesh, 0.01);
    // exact normals are normal to both parametric lines
    const Surface& s = surfaces[i];
    const double h = 1e-5;
    const Vec3 du = s.point(0.3 + h, 0.7) - s.point(0.3 - h, 0.7);
    const Vec3 dv = s.point(0.3, 0.7 + h) - s.point(0.3, 0.7 - h);
    EXPECT_LT((du.cross(dv).normalized() - s.normal(0.3, 0.7)).norm(), 1e-9) << i;
  }
}

TEST(ShellMesh, FoldsHaveANodePerDirection) {
  Facets facets = patch(plane(Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0)), 2, 2, "floor");
  facets.append(patch(plane(Vec3::Zero(), Vec3(0, 1, 0), Vec3(0, 0, 1)), 2, 2, "wall"));
  const ShellMesh mesh = make_mesh(facets, fold);
  EXPECT_EQ(mesh.size(), 18);
  ASSERT_EQ(mesh.folds.size(), 3u);
  for (const auto& nodes : mesh.folds) {
    ASSERT_EQ(nodes.size(), 2u);
    const auto d = [&](std::size_t i) {
      return mesh.directors[static_cast<std::size_t>(nodes[i])];
    };
    EXPECT_NEAR(d(0).dot(d(1)), 0.0, 1e-15);
  }
  // within the threshold the same edge is smooth
  const ShellMesh smooth = make_mesh(facets, 0.51 * pi);
  EXPECT_EQ(smooth.size(), 15);
  EXPECT_TRUE(smooth.folds.empty());
}

TEST(ShellMesh, ISectionJoinsFlangesAndKeepsTheWebApart) {
  const ShellMesh mesh = make_mesh(i_section({2.0, 1.0, 1.5}, 10.0, 2, 4, 5), fold);
  // per station: flanges 5 nodes each, web 5
  EXPECT_EQ(mesh.size(), 15 * 6);
  EXPECT_EQ(mesh.folds.size(), 2u * 6u);
  EXPECT_EQ(mesh.edges.at("start").size(), 15u);
  EXPECT_NEAR(area(mesh), 10.0 * (2.0 + 1.0 + 1.5), 1e-12);
  for (int q : mesh.parts.at("top left")) EXPECT_GT(mesh.slots(q).col(1).y(), 0.99);
  for (int q : mesh.parts.at("bottom right")) EXPECT_LT(mesh.slots(q).col(1).y(), -0.99);
  expect_sound(mesh, 0.05);
}

TEST(ShellMesh, AirfoilHasWebsAndASharpTrailingEdge) {
  const ShellMesh mesh = make_mesh(airfoil(1.0, 0.2, 3.0, {0.2, 0.5}, 40, 3, 4), fold);
  // folds at the trailing edge and at both ends of both webs
  EXPECT_EQ(mesh.folds.size(), 5u * 5u);
  EXPECT_EQ(mesh.parts.at("web 2").size(), 12u);
  EXPECT_NEAR(mesh.positions[0].x(), 1.0, 1e-15);
  double top = 0.0;
  for (const Vec3& x : mesh.positions) top = std::max(top, x.y());
  EXPECT_NEAR(top, 0.1, 1e-3);
  expect_sound(mesh, 0.002);
  for (int q : mesh.parts.at("web 1")) EXPECT_NEAR(mesh.slots(q)(0, 0), 0.2, 1e-12);
}

TEST(ShellMesh, PointsOnlyGiveAveragedDirectors) {
  // a tube known by its points: mean of the normals of two elements, radial by symmetry
  Facets facets = patch(cylinder(2.0, 1.0), 24, 1, "tube");
  for (std::size_t q = 0; q < facets.quads.size(); ++q) {
    std::array<Vec3, 4> points;
    for (std::size_t c = 0; c < 4; ++c) {
      points[c] = facets.points[static_cast<std::size_t>(facets.quads[q][c])];
    }
    facets.normals[q] = corner_normals(points);
  }
  const ShellMesh mesh = make_mesh(facets, fold);
  EXPECT_TRUE(mesh.folds.empty());
  for (std::size_t a = 0; a < mesh.positions.size(); ++a) {
    const Vec3 out(mesh.positions[a].x(), mesh.positions[a].y(), 0.0);
    EXPECT_LT((mesh.directors[a] - out.normalized()).norm(), 1e-14);
  }
}

TEST(ShellMesh, ElementsInAnyOrderShareTheirNodes) {
  const Facets rows = patch(plane(Vec3::Zero(), Vec3(3, 0, 0), Vec3(0, 3, 0)), 3, 3, "plate");
  std::vector<std::size_t> order(9);
  std::iota(order.begin(), order.end(), std::size_t{0});
  // with two turns of each element's first corner, and all orders of four elements about a point
  for (std::size_t turn = 0; turn < 2; ++turn) {
    do {
      Facets mixed;
      mixed.points = rows.points;
      for (std::size_t q : order) {
        std::array<int, 4> quad = rows.quads[q];
        std::array<Vec3, 4> normals = rows.normals[q];
        std::rotate(quad.begin(), quad.begin() + static_cast<long>(turn * (q % 4)), quad.end());
        mixed.quads.push_back(quad);
        mixed.normals.push_back(normals);
      }
      const ShellMesh mesh = make_mesh(mixed, fold);
      ASSERT_EQ(mesh.size(), 16);
      ASSERT_TRUE(mesh.folds.empty());
    } while (std::next_permutation(order.begin(), order.begin() + 6));
  }
}

TEST(MeshQuality, MeasuresElements) {
  const ShellMesh mesh =
      make_mesh(patch(plane(Vec3::Zero(), Vec3(4, 0, 0), Vec3(1, 1, 0)), 2, 1, "plate"), fold);
  const MeshQuality quality = mesh_quality(mesh);
  EXPECT_NEAR(quality.largest_aspect, std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(quality.smallest_angle, 0.25 * pi, 1e-14);
  EXPECT_NEAR(quality.largest_angle, 0.75 * pi, 1e-14);
  EXPECT_NEAR(quality.largest_warp, 0.0, 1e-14);
  const ShellMesh saddle = make_mesh(patch(hypar(1.0, 1.0), 1, 1, "patch"), fold);
  EXPECT_NEAR(mesh_quality(saddle).largest_warp, 0.0, 1e-14);  // its corners have the height 0
}

TEST(MeshQuality, FindsTurnedElements) {
  Facets facets = patch(plane(Vec3::Zero(), Vec3(2, 0, 0), Vec3(0, 1, 0)), 2, 1, "plate");
  auto& quad = facets.quads[1];
  std::reverse(quad.begin(), quad.end());
  EXPECT_EQ(make_mesh(facets, fold).turned, std::vector<int>{1});
}

}  // namespace
}  // namespace culm::shell
