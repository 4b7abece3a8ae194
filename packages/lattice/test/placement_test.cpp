#include "../src/placement.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace culm::lattice {
namespace {

using testing::HasSubstr;

// Plates of 2 m x 1 m with 4 x 4 panels, at these places of their first corners.
std::string misplaced(const std::vector<Vec3>& corners, std::optional<Vec3> mirror) {
  const std::vector<std::string> names = {"one", "two"};
  Points grid;
  for (const Vec3& corner : corners) {
    for (int i = 0; i <= 4; ++i) {
      for (int j = 0; j <= 4; ++j) grid.push_back(corner + Vec3(0.25 * i, 0.5 * j, 0.0));
    }
  }
  const BoundLattice lattice(std::vector<Panels>(corners.size(), {4, 4}), grid, mirror);
  const auto found = find_misplaced(lattice, grid, names);
  return found ? names[found->surface] + ": " + found->text : std::string();
}

TEST(Placement, SurfacesStandOnOneSideOfTheirMirror) {
  const Vec3 y = Vec3::UnitY(), z = Vec3::UnitZ();
  EXPECT_EQ(misplaced({Vec3::Zero()}, y), "");
  EXPECT_EQ(misplaced({{0.0, -2.0, 0.0}}, y), "");
  EXPECT_EQ(misplaced({{0.0, 0.0, 1e-3}}, z), "");
  EXPECT_THAT(misplaced({{0.0, -1.0, 0.0}}, y), HasSubstr("one: crosses the plane of symmetry, "
                                                          "from -1 to 1 m"));
  EXPECT_THAT(misplaced({{0.0, -0.01, 0.0}}, y), HasSubstr("begin it 0.01 m further out"));
  EXPECT_THAT(misplaced({Vec3::Zero()}, z), HasSubstr("one: lies in the plane of symmetry"));
  EXPECT_THAT(misplaced({{0.0, 0.0, 1.0}, {0.0, 0.0, -2.0}}, z),
              HasSubstr("two: stands on the other side of the plane of symmetry than 'one'"));
}

TEST(Placement, PanelsHaveDifferentPlaces) {
  EXPECT_EQ(misplaced({Vec3::Zero(), {0.0, 2.0, 0.0}}, {}), "");
  EXPECT_EQ(misplaced({Vec3::Zero(), {0.0, 0.0, 0.01}}, {}), "");
  EXPECT_THAT(misplaced({Vec3::Zero(), Vec3::Zero()}, {}),
              HasSubstr("two: has a panel in the same place as 'one'"));
  EXPECT_THAT(misplaced({Vec3::Zero(), {0.5, 1.0, 0.0}}, {}),
              HasSubstr("two: has a panel in the same place as 'one'"));
}

}  // namespace
}  // namespace culm::lattice
