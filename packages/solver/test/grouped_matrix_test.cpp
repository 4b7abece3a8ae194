#include "../src/grouped_matrix.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

namespace culm::solver {
namespace {

constexpr int columns_of_all = 40;

// Groups of different heights and widths, below and above the width of vectors.
struct Groups {
  Groups() {
    std::vector<int> first_row{0};
    std::vector<std::size_t> first_column{0};
    std::vector<int> columns;
    std::vector<double> values;
    const std::vector<std::pair<int, int>> shapes = {{6, 27}, {3, 24}, {1, 5},  {0, 4},
                                                     {7, 8},  {2, 0},  {12, 1}, {6, 33}};
    int rows = 0;
    for (const auto& [height, width] : shapes) rows += height;
    dense = Eigen::MatrixXd::Zero(rows, columns_of_all);
    for (const auto& [height, width] : shapes) {
      for (int k = 0; k < width; ++k) columns.push_back((7 * k + width) % columns_of_all);
      for (int row = 0; row < height; ++row) {
        for (int k = 0; k < width; ++k) {
          const int column = columns[first_column.back() + static_cast<std::size_t>(k)];
          values.push_back(std::sin(1.0 + 3.0 * static_cast<double>(values.size())));
          dense(first_row.back() + row, column) = values.back();
        }
      }
      first_row.push_back(first_row.back() + height);
      first_column.push_back(columns.size());
    }
    matrix = {std::move(first_row), std::move(first_column), std::move(columns), std::move(values)};
  }

  Eigen::MatrixXd dense;
  GroupedMatrix matrix;
};

std::span<double> span_of(Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

TEST(GroupedMatrix, MultipliesAsADenseOneDoes) {
  const Groups A;
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(columns_of_all, -1.0, 2.0);
  Eigen::VectorXd y = Eigen::VectorXd::Constant(A.dense.rows(), 3.0);
  A.matrix.multiply(span_of(x), span_of(y));
  EXPECT_LT((y - A.dense * x).lpNorm<Eigen::Infinity>(), 1e-13);

  Eigen::VectorXd sum = x;
  A.matrix.add_transposed(span_of(y), span_of(sum));
  EXPECT_LT((sum - x - A.dense.transpose() * y).lpNorm<Eigen::Infinity>(), 1e-12);

  sum = x;
  A.matrix.add_projection(span_of(x), span_of(sum));
  EXPECT_LT((sum - x - A.dense.transpose() * (A.dense * x)).lpNorm<Eigen::Infinity>(), 1e-12);
}

TEST(GroupedMatrix, RoundedValuesHaveSinglePrecision) {
  const Groups A;
  std::vector<float> rounded;
  A.matrix.round(rounded);
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(columns_of_all, -1.0, 2.0);
  Eigen::VectorXd y(A.dense.rows());
  A.matrix.multiply(rounded, span_of(x), span_of(y));
  const Eigen::VectorXd exact = A.dense.cast<float>().cast<double>() * x;
  EXPECT_LT((y - exact).lpNorm<Eigen::Infinity>(), 1e-13);
  EXPECT_GT((y - A.dense * x).lpNorm<Eigen::Infinity>(), 1e-9);
}

}  // namespace
}  // namespace culm::solver
