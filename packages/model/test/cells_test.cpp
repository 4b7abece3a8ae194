#include <culm/model/cells.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace culm::model {
namespace {

bool same(const Cell& a, const Cell& b) {
  return std::ranges::equal(a.nodes, b.nodes) && a.source == b.source && a.item == b.item;
}

// Whether what comes out is what went in, by number and in order.
void expect_kept(const std::vector<Cell>& given) {
  Cells cells;
  for (const Cell& cell : given) cells.push_back(cell);
  ASSERT_EQ(cells.size(), given.size());
  EXPECT_EQ(cells.empty(), given.empty());
  std::size_t i = 0;
  for (const Cell& cell : cells) {
    EXPECT_TRUE(same(cell, given[i])) << i;
    EXPECT_TRUE(same(cells[i], given[i])) << i;
    ++i;
  }
  EXPECT_EQ(i, given.size());
}

TEST(Cells, OfALineGoOnByElements) {
  std::vector<Cell> line;
  for (int k = 0; k < 5; ++k) line.push_back({{2 * k, 2 * k + 1, 2 * k + 2}, nullptr, 3 + k});
  expect_kept(line);
}

TEST(Cells, OfAMeshBeginAnewWithEachRow) {
  std::vector<Cell> mesh;
  for (int row = 0; row < 3; ++row) {
    for (int k = 0; k < 4; ++k) {
      const int first = 5 * row + k;
      mesh.push_back({{first, first + 1, first + 6, first + 5}, nullptr, 4 * row + k});
    }
  }
  expect_kept(mesh);
}

TEST(Cells, NeedNotGoOnEvenly) {
  const auto* const source = reinterpret_cast<const ResultantSource*>(0x10);
  expect_kept({});
  expect_kept({{{4}, nullptr, 0}});
  expect_kept({{{4}, nullptr, 0}, {{4}, nullptr, 0}, {{5}, nullptr, 0}, {{5}, source, 1}});
  expect_kept({{{0, 1}, source, 0},
               {{1, 2}, source, 1},
               {{2, 4}, source, 2},
               {{4, 3}, source, 3},
               {{4, 3}, source, 4},
               {{3, 2, 1}, source, 5},
               {{2, 1}, source, 6}});
}

}  // namespace
}  // namespace culm::model
