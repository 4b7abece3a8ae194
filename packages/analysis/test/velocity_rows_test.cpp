#include <culm/analysis/velocity_rows.hpp>
#include <culm/math/types.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace culm::analysis {
namespace {

// Numbers of a row by the six unknowns, joined over its four nodes.
template <class Join>
Vec6 joined(const NodeRow& row, Join join) {
  Vec6 result = Vec6::Zero();
  for (int i = 0; i < 24; ++i) result[i % 6] = join(result[i % 6], row.of(i % 8, i / 8));
  return result;
}

class VelocityRowsTest : public ::testing::TestWithParam<int> {
 protected:
  VelocityRowsTest() {
    std::srand(7);
    start_ = random();
    mean_ = random();
    for (auto& past : past_) past = random();
    rows_.start = start_.data();
    rows_.mean = mean_.data();
  }
  Eigen::MatrixXd random() const { return Eigen::MatrixXd::Random(6, GetParam()); }

  Eigen::MatrixXd start_;
  Eigen::MatrixXd mean_;
  std::array<Eigen::MatrixXd, max_past> past_;
  VelocityRows rows_;
};

TEST_P(VelocityRowsTest, ErrorsAreTheLargestOfAllNodes) {
  std::array<GuessWeights, max_past> weights{};
  for (std::size_t p = 0; p < max_past; ++p) {
    for (std::size_t k = 0; k <= p; ++k) {
      weights[p][k] = 0.3 + static_cast<double>(p) - 0.7 * static_cast<double>(k);
    }
  }
  for (std::size_t num_past = 0; num_past <= max_past; ++num_past) {
    rows_.num_past = num_past;
    for (std::size_t k = 0; k < num_past; ++k) rows_.past[k] = past_[k].data();
    GuessErrors errors{};
    compare_guesses(rows_, static_cast<std::size_t>(GetParam()), weights, errors);
    for (std::size_t p = 0; p <= max_past; ++p) {
      Eigen::MatrixXd guess = Eigen::MatrixXd::Zero(6, GetParam());
      for (std::size_t k = 0; k < p; ++k) guess += weights[p - 1][k] * past_[k];
      const Vec6 expected =
          p > num_past ? Vec6(Vec6::Zero())
                       : Vec6(((p == 0 ? start_ : guess) - mean_).cwiseAbs().rowwise().maxCoeff());
      const Vec6 found = joined(errors[p], [](double a, double b) { return std::max(a, b); });
      EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-14) << num_past << " " << p;
    }
  }
}

TEST_P(VelocityRowsTest, ChangesAreSummedOverAllNodes) {
  rows_.num_past = 1;
  rows_.past[0] = past_[0].data();
  VelocityChanges changes{};
  add_changes(rows_, static_cast<std::size_t>(GetParam()), changes);
  const Eigen::MatrixXd before = start_ - past_[0];
  const Eigen::MatrixXd after = mean_ - start_;
  const auto expect = [](const NodeRow& row, const Eigen::MatrixXd& products) {
    const Vec6 found = joined(row, [](double a, double b) { return a + b; });
    EXPECT_LT((found - Vec6(products.rowwise().sum())).cwiseAbs().maxCoeff(), 1e-13);
  };
  expect(changes.before, before.cwiseProduct(before));
  expect(changes.after, after.cwiseProduct(after));
  expect(changes.both, before.cwiseProduct(after));
}

INSTANTIATE_TEST_SUITE_P(Nodes, VelocityRowsTest, ::testing::Values(1, 3, 4, 5, 16, 31));

}  // namespace
}  // namespace culm::analysis
