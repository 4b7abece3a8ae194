#include <culm/parallel/partition.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace culm::parallel {
namespace {

Graph chain(int vertices) {
  Graph graph;
  for (int v = 0; v < vertices; ++v) {
    if (v > 0) graph.neighbours.push_back(v - 1);
    if (v + 1 < vertices) graph.neighbours.push_back(v + 1);
    graph.begin.push_back(static_cast<int>(graph.neighbours.size()));
    graph.weights.push_back(6);
  }
  return graph;
}

TEST(Partition, ChainIsCutIntoEqualRuns) {
  const std::vector<int> owner = partition(chain(90), 3);
  for (int rank = 0; rank < 3; ++rank) {
    EXPECT_NEAR(static_cast<double>(std::count(owner.begin(), owner.end(), rank)), 30.0, 2.0);
  }
  int cuts = 0;
  for (std::size_t v = 1; v < owner.size(); ++v) cuts += owner[v] != owner[v - 1] ? 1 : 0;
  EXPECT_EQ(cuts, 2);
}

// So that the rows of a chain are numbered from rank to rank.
TEST(Partition, PartsAreNumberedAsTheyBegin) {
  const std::vector<int> owner = partition(chain(90), 5);
  EXPECT_TRUE(std::ranges::is_sorted(owner));
  EXPECT_EQ(owner.front(), 0);
  EXPECT_EQ(owner.back(), 4);
}

TEST(Partition, IsReproducible) { EXPECT_EQ(partition(chain(57), 4), partition(chain(57), 4)); }

TEST(Partition, OneRankOwnsEverything) {
  const std::vector<int> owner = partition(chain(5), 1);
  EXPECT_EQ(std::count(owner.begin(), owner.end(), 0), 5);
}

TEST(Dissection, EachVertexHasOnePlaceAndSeparatorsComeLast) {
  std::vector<int> place = dissect(chain(31));
  const auto last = std::max_element(place.begin(), place.end()) - place.begin();
  EXPECT_GT(last, 3);  // the first separator cuts the chain in two
  EXPECT_LT(last, 27);
  EXPECT_EQ(place, dissect(chain(31)));
  std::sort(place.begin(), place.end());
  for (int v = 0; v < 31; ++v) EXPECT_EQ(place[static_cast<std::size_t>(v)], v);
}

TEST(Dissection, TakesGraphsWithoutEdges) {
  const Graph lonely{{0, 0, 0}, {}, {6, 6}};
  EXPECT_EQ(dissect(lonely), (std::vector<int>{0, 1}));
  EXPECT_TRUE(dissect(Graph{}).empty());
}

}  // namespace
}  // namespace culm::parallel
