#include <culm/model/scatter.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

namespace culm::model {
namespace {

constexpr int num_nodes = 400;
constexpr int row_length = 12;  // of a node and its neighbour, which are the same two in all rows

BlockShape shape_of_node() {
  BlockShape shape{6, 6, {}, 0};
  std::iota(shape.position.begin(), shape.position.begin() + 6, std::int8_t{0});
  return shape;
}

// A row of elements of two nodes; each node couples with one neighbour. Adds ones by all items, in
// some order, to values that are those of another matrix or zero.
std::vector<double> add_ones(const std::vector<int>& order, bool is_stale) {
  static const BlockShape shape = shape_of_node();
  Scatter scatter;
  for (int node = 0; node < num_nodes; node += 2) {
    const std::array<Scatter::Rows, 2> rows{Scatter::Rows{6 * node, &shape},
                                            Scatter::Rows{6 * node + 6, &shape}};
    scatter.add_item(rows, std::array{0, 6, 0, 6});
  }
  std::vector<std::size_t> row_begin;
  for (int row = 0; row <= 6 * num_nodes; ++row) {
    row_begin.push_back(static_cast<std::size_t>(row_length * row));
  }
  std::vector<double> values(row_begin.back(), is_stale ? 7.0 : 0.0);
  Target target;
  target.values = values;
  target.row_begin = row_begin;
  if (is_stale) target.stale_from = 0;
  const RowMat<6, 12> K = RowMat<6, 12>::Ones();
  for (const int item : order) {
    scatter.add_tangent_rows<2>(static_cast<std::size_t>(item), 0, K.data(), target);
    scatter.add_tangent(static_cast<std::size_t>(item), 1, 1, K.leftCols<6>(), target);
  }
  target.clear_rest();
  EXPECT_EQ(target.stale_from, Target::none);
  return values;
}

TEST(Scatter, StaleValuesAreZeroBeforeItemsAddToThemInAnyOrder) {
  std::vector<int> order(num_nodes / 2);
  std::iota(order.begin(), order.end(), 0);
  const auto compare = [&] { EXPECT_EQ(add_ones(order, true), add_ones(order, false)); };
  compare();
  order.insert(order.end(), order.begin(), order.end());  // another batch
  compare();
  std::reverse(order.begin(), order.end());
  compare();
  order.resize(3);  // and rows that nobody adds to
  compare();
}

}  // namespace
}  // namespace culm::model
