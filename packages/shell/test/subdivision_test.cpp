#include <culm/shell/subdivision.hpp>
#include <culm/shell/surfaces.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace culm::shell {
namespace {

// The same quadrilaterals as if nothing were known but their corners.
ShellMesh divided(Facets facets, int refinement) {
  constexpr double fold = 0.35;
  facets.parents.clear();
  return make_mesh(subdivide(facets, make_mesh(facets, fold), refinement), fold);
}

double largest_error_on_sphere(int elements) {
  const Facets facets = patch(sphere(2.0, -0.5, 0.7, {0.0, 1.0}), elements, elements, "zone");
  double error = 0.0;
  for (const Vec3& x : divided(facets, 4).positions) {
    error = std::max(error, std::abs(x.norm() - 2.0));
  }
  return error;
}

TEST(Subdivision, KeepsFlatFacetsFlat) {
  const Facets facets = patch(plane(Vec3::Zero(), Vec3(3, 0, 0), Vec3(1, 2, 0)), 3, 2, "plate");
  const ShellMesh mesh = divided(facets, 3);
  EXPECT_EQ(mesh.size(), 10 * 7);
  for (const Vec3& x : mesh.positions) EXPECT_EQ(x.z(), 0.0);
  EXPECT_EQ(mesh.edges.at("plate u1").size(), 7u);
  EXPECT_EQ(mesh.edges.at("plate v0").size(), 10u);
  EXPECT_EQ(mesh.parts.at("plate").size(), 54u);
}

TEST(Subdivision, FollowsASmoothSurfaceToFourthOrder) {
  // the normals at the border of the zone are exact here; between corners known exactly the cubic
  // edges miss the circle by the fourth power of their length
  const double order = std::log2(largest_error_on_sphere(4) / largest_error_on_sphere(8));
  EXPECT_GT(order, 3.8);
}

TEST(Subdivision, EdgesOfFoldsStayStraightAndTogether) {
  Facets facets = patch(plane(Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0)), 2, 2, "floor");
  facets.append(patch(plane(Vec3::Zero(), Vec3(0, 1, 0), Vec3(0, 0, 1)), 2, 2, "wall"));
  const ShellMesh mesh = divided(facets, 3);
  EXPECT_EQ(mesh.folds.size(), 7u);
  EXPECT_EQ(mesh.fold_lines, 1);
}

TEST(Subdivision, PointsStayPoints) {
  Facets facets = patch(plane(Vec3::Zero(), Vec3(2, 0, 0), Vec3(0, 1, 0)), 2, 1, "plate");
  facets.edges["ends"] = {{0, 0}, {0, 3}};  // two points, not the line between them
  facets.points_only.insert("ends");
  EXPECT_EQ(divided(facets, 4).edges.at("ends").size(), 2u);
}

}  // namespace
}  // namespace culm::shell
