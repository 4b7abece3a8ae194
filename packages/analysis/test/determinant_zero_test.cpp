#include "../src/determinant_zero.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace culm::analysis {
namespace {

using solver::Determinant;

Determinant determinant_of(double value, double log_scale = 0.0) {
  return {value > 0.0 ? 1 : -1, std::log(std::abs(value)) + log_scale};
}

TEST(ApproachZero, FindsWhereADeterminantOfAnySizeChangesItsSign) {
  // too large for a number, and larger by nine powers of ten at one end than at the other
  const auto at = [](double x) { return determinant_of((0.3 - x) * std::exp(20.0 * x), 5000.0); };
  int tried = 0;
  const double zero = approach_zero(at(0.0), at(1.0), 1.0, [&](double x) {
    ++tried;
    return std::optional(at(x));
  });
  EXPECT_NEAR(zero, 0.3, 1e-3);
  EXPECT_LE(tried, 20);
}

TEST(ApproachZero, DoesNotSearchWhereTheSignsAreTheSame) {
  const Determinant one = determinant_of(1.0);
  EXPECT_EQ(approach_zero(one, one, 1.0,
                          [](double) -> std::optional<Determinant> {
                            ADD_FAILURE() << "nothing to look for";
                            return {};
                          }),
            0.0);
}

TEST(ApproachZero, KeepsTheLastPlaceThatHasADeterminant) {
  int tried = 0;
  double last = 0.0;
  const double found = approach_zero(determinant_of(1.0), determinant_of(-3.0), 2.0,
                                     [&](double x) -> std::optional<Determinant> {
                                       if (++tried == 3) return {};
                                       last = x;
                                       return determinant_of(1.0 - std::pow(x, 3.0));
                                     });
  EXPECT_EQ(found, last);
  EXPECT_EQ(tried, 3);
  EXPECT_GT(found, 0.0);
}

}  // namespace
}  // namespace culm::analysis
