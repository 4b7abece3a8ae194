#include "../src/row_groups.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

namespace culm::solver {
namespace {

constexpr int columns_of_all = 40;

// Groups of different heights and widths, below and above the width of vectors, over columns that
// stand alone and together. All values have single precision.
struct Groups {
  Groups() {
    std::vector<int> first_row{0};
    std::vector<std::size_t> first_column{0};
    std::vector<int> columns;
    const std::vector<std::pair<int, int>> shapes = {{6, 27}, {3, 24}, {1, 5},  {0, 4},
                                                     {7, 8},  {2, 0},  {12, 1}, {6, 33}};
    int rows = 0;
    for (const auto& [height, width] : shapes) rows += height;
    dense = Eigen::MatrixXd::Zero(rows, columns_of_all);
    for (const auto& [height, width] : shapes) {
      for (int k = 0; k < width; ++k)
        columns.push_back(((k / 4) * 11 + k % 4 + width) % columns_of_all);
      for (int row = 0; row < height; ++row) {
        for (int k = 0; k < width; ++k) {
          const int column = columns[first_column.back() + static_cast<std::size_t>(k)];
          rounded.push_back(std::sin(1.0F + 3.0F * static_cast<float>(rounded.size())));
          values.push_back(rounded.back());
          dense(first_row.back() + row, column) += values.back();
        }
      }
      first_row.push_back(first_row.back() + height);
      first_column.push_back(columns.size());
    }
    layout = {std::move(first_row), std::move(first_column), std::move(columns)};
  }

  Eigen::MatrixXd dense;
  RowGroups layout;
  std::vector<double> values;
  std::vector<float> rounded;
};

std::span<double> span_of(Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

TEST(RowGroups, MultiplyAsADenseMatrixDoes) {
  const Groups A;
  ASSERT_EQ(A.layout.first_value(A.layout.groups()), A.values.size());
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(columns_of_all, -1.0, 2.0);
  Eigen::VectorXd y = Eigen::VectorXd::Constant(A.dense.rows(), 3.0);
  A.layout.multiply(A.values.data(), span_of(x), span_of(y));
  EXPECT_LT((y - A.dense * x).lpNorm<Eigen::Infinity>(), 1e-13);

  A.layout.add_product(A.values.data(), span_of(x), span_of(y));
  EXPECT_LT((y - 2.0 * A.dense * x).lpNorm<Eigen::Infinity>(), 1e-13);

  A.layout.subtract_product(A.rounded.data(), span_of(x), span_of(y), span_of(y));
  EXPECT_LT((y - A.dense * x).lpNorm<Eigen::Infinity>(), 1e-13);

  Eigen::VectorXd sum = x;
  A.layout.add_transposed(A.values.data(), span_of(y), span_of(sum));
  EXPECT_LT((sum - x - A.dense.transpose() * y).lpNorm<Eigen::Infinity>(), 1e-12);

  sum = x;
  A.layout.add_projection(A.rounded.data(), span_of(x), span_of(sum));
  EXPECT_LT((sum - x - A.dense.transpose() * (A.dense * x)).lpNorm<Eigen::Infinity>(), 1e-12);
}

}  // namespace
}  // namespace culm::solver
