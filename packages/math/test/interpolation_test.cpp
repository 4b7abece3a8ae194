#include <culm/math/interpolation.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace culm {
namespace {

TEST(Interpolation, GoesThroughCubics) {
  const auto rule = gauss_legendre(4);
  const auto cubic = [](double xi) { return 1.0 + xi * (2.0 - xi * (3.0 + 0.5 * xi)); };
  for (double xi : {-1.0, -0.3, 0.0, 0.7, 1.0}) {
    double sum = 0.0;
    for (std::size_t k = 0; k < rule.size(); ++k) sum += lagrange(rule, k, xi) * cubic(rule[k].xi);
    EXPECT_NEAR(sum, cubic(xi), 1e-14);
  }
}

}  // namespace
}  // namespace culm
