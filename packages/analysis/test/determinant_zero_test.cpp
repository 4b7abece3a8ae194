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
  const auto zero = approach_zero({0.0, at(0.0)}, {1.0, at(1.0)}, [&](double x) {
    ++tried;
    return std::optional(at(x));
  });
  EXPECT_NEAR(zero.place, 0.3, 1e-3);
  EXPECT_LE(tried, 20);
}

// Next to a crossing of paths equilibria cannot be found, or are those of the other path.
TEST(ApproachZero, ClosesInOnPlacesWithoutADeterminant) {
  const auto value = [](double x) { return 1.0 - std::pow(x, 3.0); };
  const auto zero =
      approach_zero({0.0, determinant_of(value(0.0))}, {2.0, determinant_of(value(2.0))},
                    [&](double x) -> std::optional<Determinant> {
                      if (std::abs(x - 1.0) < 0.01) return {};
                      return determinant_of(value(x));
                    });
  EXPECT_FALSE(zero.is_found);
  EXPECT_NEAR(zero.place, 1.0, 1e-3);  // the square of the gap
  EXPECT_NEAR(zero.before, 0.98, 0.01);
  EXPECT_NEAR(zero.after, 1.02, 0.01);
}

TEST(ApproachZero, WithoutAnyPlaceBetweenTakesTheEnds) {
  const auto zero = approach_zero({0.0, determinant_of(1.0)}, {2.0, determinant_of(-3.0)},
                                  [](double) -> std::optional<Determinant> { return {}; });
  EXPECT_FALSE(zero.is_found);
  EXPECT_DOUBLE_EQ(zero.place, 0.5);
  EXPECT_EQ(zero.before, 0.0);
  EXPECT_EQ(zero.after, 2.0);
}

}  // namespace
}  // namespace culm::analysis
