#include <culm/math/lagrange.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace culm {
namespace {

template <class Shape>
class LagrangeShape : public testing::Test {};
using Orders = testing::Types<Lagrange<1>, Lagrange<2>, Lagrange<3>>;
TYPED_TEST_SUITE(LagrangeShape, Orders);

TYPED_TEST(LagrangeShape, IsOneAtItsNodeAndZeroAtTheOthers) {
  for (int b = 0; b < TypeParam::num_nodes; ++b) {
    const auto N = TypeParam::values(TypeParam::node(b));
    for (int a = 0; a < TypeParam::num_nodes; ++a) EXPECT_NEAR(N[a], a == b ? 1.0 : 0.0, 1e-15);
  }
}

TYPED_TEST(LagrangeShape, ReproducesPolynomialsOfItsOrderAndTheirDerivatives) {
  const double xi = 0.3721;
  const auto N = TypeParam::values(xi);
  const auto dN = TypeParam::derivatives(xi);
  for (int degree = 0; degree < TypeParam::num_nodes; ++degree) {
    double value = 0.0;
    double slope = 0.0;
    for (int a = 0; a < TypeParam::num_nodes; ++a) {
      value += N[a] * std::pow(TypeParam::node(a), degree);
      slope += dN[a] * std::pow(TypeParam::node(a), degree);
    }
    EXPECT_NEAR(value, std::pow(xi, degree), 1e-15);
    EXPECT_NEAR(slope, degree == 0 ? 0.0 : degree * std::pow(xi, degree - 1), 1e-14);
  }
}

}  // namespace
}  // namespace culm
