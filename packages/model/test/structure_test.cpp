#include <culm/model/structure.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace culm::model {
namespace {

// Two elements of three nodes, 1 m and 3 m long, with two points each.
Structure line() {
  Structure structure;
  structure.nodes = {0, 1, 2, 3, 4};
  structure.cells = {{{0, 1, 2}, nullptr, 0}, {{2, 3, 4}, nullptr, 1}};
  for (double length : {0.5, 0.5, 1.5, 1.5}) structure.line_points.push_back({{}, length});
  return structure;
}

TEST(MarkerAtFraction, IsTheNodeWhereThereIsOne) {
  // ends, the common node at 1 m and the middles
  for (const auto& [fraction, node] :
       {std::pair{0.0, 0}, {0.125, 1}, {0.25, 2}, {0.625, 3}, {1.0, 4}}) {
    const auto marker = marker_at_fraction(line(), fraction);
    ASSERT_TRUE(marker);
    EXPECT_EQ(marker->nodes, std::vector{node});
    EXPECT_EQ(marker->weights, std::vector{1.0});
  }
}

TEST(MarkerAtFraction, InterpolatesBetweenNodes) {
  const auto marker = marker_at_fraction(line(), 0.25 + 0.75 * 0.3);
  ASSERT_TRUE(marker);
  EXPECT_EQ(marker->nodes, (std::vector{2, 3, 4}));
  const std::vector<double>& N = marker->weights;
  EXPECT_NEAR(std::accumulate(N.begin(), N.end(), 0.0), 1.0, 1e-15);
  // quadratic functions are met: xi = -0.4
  EXPECT_NEAR(N[2] - N[0], -0.4, 1e-15);
  EXPECT_NEAR(N[2] + N[0], 0.16, 1e-15);
}

// The inner node stands at 0.6 m of 2 m: s = 0.6 (1 - xi^2) + xi (1 + xi), and shares are those of
// its rate 1 + 0.8 xi.
TEST(MarkerAtFraction, IsAtItsLengthWhereNodesAreUneven) {
  Structure structure;
  structure.nodes = {0, 1, 2};
  structure.cells = {{{0, 1, 2}, nullptr, 0}};
  for (const double xi : {-std::sqrt(1.0 / 3.0), std::sqrt(1.0 / 3.0)}) {
    structure.line_points.push_back({{}, 1.0 + 0.8 * xi});
  }
  const auto marker = marker_at_fraction(structure, 0.5);
  ASSERT_TRUE(marker);
  EXPECT_NEAR(0.6 * marker->weights[1] + 2.0 * marker->weights[2], 1.0, 1e-14);
  EXPECT_EQ(marker_at_fraction(structure, 0.3)->nodes, std::vector{1});
}

TEST(MarkerAtFraction, ABodyHasNone) {
  Structure body;
  body.nodes = {0};
  body.cells = {{{0}, nullptr, 0}};
  EXPECT_FALSE(marker_at_fraction(body, 0.5));
}

}  // namespace
}  // namespace culm::model
