#include <culm/base/error.hpp>
#include <culm/shell/gmsh_reader.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace culm::shell {
namespace {

// A floor of 2 x 1 elements with a wall of one on the middle line: nodes 1 2 3 / 4 5 6, wall 7 8.
const std::string names = R"($PhysicalNames
5
0 1 "tip"
1 2 "front"
1 3 "seam"
2 4 "the floor"
2 5 "wall"
$EndPhysicalNames
)";

const std::string version_2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
)" + names + R"($Nodes
8
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
17 1 0 1
18 1 1 1.5e0
$EndNodes
$Elements
7
1 15 2 1 1 3
2 1 2 2 1 1 2
3 1 2 2 1 2 3
4 1 2 3 2 2 5
5 3 2 4 1 1 2 5 4
6 3 2 4 1 2 3 6 5
7 3 2 5 2 2 5 18 17
$EndElements
)";

const std::string version_4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
)" + names + R"($Entities
1 2 2 0
1 2 0 0 1 1
1 0 0 0 2 0 0 1 2 2 1 -2
2 1 0 0 1 1 0 1 3 0
1 0 0 0 2 1 0 1 4 1 1
2 1 0 0 1 1 1 1 5 0
$EndEntities
$Nodes
2 8 1 18
2 1 0 6
1
2
3
4
5
6
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
2 2 1 2
17
18
1 0 1 0.5 0.5
1 1 1.5 0.5 0.5
$EndNodes
$Elements
5 7 1 7
0 1 15 1
1 3
1 1 1 2
2 1 2
3 2 3
1 2 1 1
4 2 5
2 1 3 2
5 1 2 5 4
6 2 3 6 5
2 2 3 1
7 2 5 18 17
$EndElements
$Periodic
0
$EndPeriodic
)";

TEST(GmshReader, ReadsBothFormatsAlike) {
  for (const std::string& text : {version_2, version_4}) {
    const ShellMesh mesh = make_mesh(read_gmsh(text, "a.msh"), 0.3);
    EXPECT_EQ(mesh.quads.size(), 3u);
    EXPECT_EQ(mesh.size(), 10);  // two more on the seam
    EXPECT_EQ(mesh.folds.size(), 2u);
    EXPECT_EQ(mesh.parts.at("the floor"), (std::vector{0, 1}));
    EXPECT_EQ(mesh.parts.at("wall"), std::vector{2});
    EXPECT_EQ(mesh.edges.at("front").size(), 3u);
    EXPECT_EQ(mesh.edges.at("tip").size(), 1u);
    EXPECT_EQ(mesh.edges.at("seam").size(), 4u);  // floor and wall
    const int tip = mesh.edges.at("tip")[0];
    EXPECT_EQ(mesh.positions[static_cast<std::size_t>(tip)], Vec3(2, 0, 0));
    const ShellForms::Nodes wall = mesh.slots(2);
    EXPECT_EQ(wall.col(4), Vec3(1, 1, 1.5));
    EXPECT_EQ(wall.col(5), Vec3(1, 0, 0));
  }
}

TEST(GmshReader, GroupsWithoutNameHaveTheirNumber) {
  std::string text = version_2;
  text.erase(text.find("$PhysicalNames"), names.size());
  EXPECT_EQ(read_gmsh(text, "a.msh").parts.at("5"), std::vector{2});
}

// MSH 2 writes an element once for each of its groups.
TEST(GmshReader, AnElementOfTwoGroupsIsOne) {
  std::string text = version_2;
  text.replace(text.find("$Elements\n7"), 11, "$Elements\n8");
  text.replace(text.find("$EndElements"), 0, "8 3 2 9 1 2 3 6 5\n");
  const Facets facets = read_gmsh(text, "a.msh");
  EXPECT_EQ(facets.quads.size(), 3u);
  EXPECT_EQ(facets.parts.at("the floor"), (std::vector{0, 1}));
  EXPECT_EQ(facets.parts.at("9"), std::vector{1});
}

TEST(GmshReader, NeighboursWithTheirNormalOnTheOtherSideAreTold) {
  std::string text = version_2;
  const std::string floor = "2 3 6 5\n";
  text.replace(text.find(floor), floor.size(), "5 6 3 2\n");
  const ShellMesh mesh = make_mesh(read_gmsh(text, "a.msh"), 0.3);
  EXPECT_TRUE(mesh.turned.empty()) << "a wall stands on the seam: which is the other side there?";
  const std::string wall = "7 3 2 5 2 2 5 18 17\n";
  text.erase(text.find(wall), wall.size());
  text.replace(text.find("$Elements\n7"), 11, "$Elements\n6");
  EXPECT_EQ(make_mesh(read_gmsh(text, "a.msh"), 0.3).turned, std::vector{1});
}

std::string message(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  try {
    read_gmsh(text, "a.msh");
  } catch (const FileError& error) {
    return error.what();
  }
  return "none";
}

TEST(GmshReader, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(message(version_2, "2.2 0", "4.0 0"),
            "a.msh: line 2: is in format MSH 4.0; save it as 2.2 or 4.1");
  EXPECT_EQ(message(version_2, "2.2 0", "2.2 1"), "a.msh: line 2: is binary; save it as ASCII");
  EXPECT_EQ(message(version_2, "5 3 2 4 1 1 2 5 4", "5 2 2 4 1 1 2 5"),
            "a.msh: line 29: element 5 is of type 2; shells are made of four-node quadrilaterals "
            "(type 3): recombine triangles, order 1");
  EXPECT_EQ(message(version_2, "1 2 5 4", "1 2 5 9"), "a.msh: line 29: there is no node 9");
  EXPECT_EQ(message(version_4, "1 0 1 0.5 0.5", "1 O 1 0.5 0.5"),
            "a.msh: line 38: expected a number, found 'O'");
  EXPECT_THAT(message(version_2, "1 2 \"front\"", "1 2 \"tip\""),
              testing::HasSubstr("a physical point and a physical curve are both called 'tip'"));
  EXPECT_EQ(message(version_2, "$EndElements", ""), "a.msh: line 33: the file ends too early");
}

}  // namespace
}  // namespace culm::shell
