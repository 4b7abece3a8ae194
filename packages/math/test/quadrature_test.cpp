#include <culm/math/quadrature.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace culm {
namespace {

class GaussLegendre : public testing::TestWithParam<int> {};

TEST_P(GaussLegendre, IntegratesPolynomialsUpToDegreeTwiceThePointsMinusOne) {
  const int points = GetParam();
  for (int degree = 0; degree < 2 * points; ++degree) {
    double integral = 0.0;
    for (const auto& [xi, weight] : gauss_legendre(points))
      integral += weight * std::pow(xi, degree);
    const double exact = degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0;
    EXPECT_NEAR(integral, exact, 1e-15) << "degree " << degree;
  }
}

TEST_P(GaussLegendre, DoesNotIntegrateTheNextDegree) {
  const int points = GetParam();
  double integral = 0.0;
  for (const auto& [xi, weight] : gauss_legendre(points)) {
    integral += weight * std::pow(xi, 2 * points);
  }
  EXPECT_GT(std::abs(integral - 2.0 / (2 * points + 1)), 1e-5);
}

TEST_P(GaussLegendre, IsSymmetricAndAscending) {
  const auto rule = gauss_legendre(GetParam());
  for (std::size_t g = 0; g < rule.size(); ++g) {
    EXPECT_EQ(rule[g].xi, -rule[rule.size() - 1 - g].xi);
    EXPECT_EQ(rule[g].weight, rule[rule.size() - 1 - g].weight);
    if (g > 0) {
      EXPECT_LT(rule[g - 1].xi, rule[g].xi);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OneToSixPoints, GaussLegendre, testing::Range(1, 7));

}  // namespace
}  // namespace culm
