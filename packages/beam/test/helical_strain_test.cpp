#include <culm/beam/helical_strain.hpp>

#include <Eigen/Geometry>
#include <culm_kit/finite_difference.hpp>
#include <culm_kit/rigid_motion.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace culm::beam {
namespace {

using kit::central_difference;
using kit::relative_difference;

constexpr double h = 0.7;

// Invariants of a rigid motion by rotation vector psi and position r.
Vec<7> invariants(const Vec3& psi, const Vec3& r) {
  const Mat3 Lam = exp_rotation(psi);
  Vec<7> z;
  z << 0.5 * (Lam.trace() - 1.0), 0.5 * (Lam(2, 1) - Lam(1, 2)), 0.5 * (Lam(0, 2) - Lam(2, 0)),
      0.5 * (Lam(1, 0) - Lam(0, 1)), r;
  return z;
}

// 0.444 and 0.451 lie on both sides of the place where the series takes over.
class HelicalStrain : public testing::TestWithParam<double> {
 protected:
  const Vec3 psi = GetParam() * Vec3(0.3, -0.7, 0.5).normalized();
  const Vec3 r = Vec3(0.2, 0.1, 0.9);
  const Vec<7> z = invariants(psi, r);
  const Vec6 w = kit::Random(1).matrix<6, 1>();
};

TEST_P(HelicalStrain, IsTheLogarithmOfTheRelativeMotion) {
  // r = V Γ with V = int_0^1 exp(s psi) ds, here by the Simpson rule with 2000 intervals
  Mat3 V = Mat3::Zero();
  const int n = 2000;
  for (int i = 0; i <= n; ++i) {
    const double weight = (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) / (3.0 * n);
    V += weight * exp_rotation(psi * i / n);
  }
  const Vec6 e = helical_strain(z, h);
  const double tolerance = GetParam() < 2.5 ? 2e-14 : 2e-13;  // angle from a cosine near -1
  EXPECT_LT((V * e.head<3>() - r).norm(), tolerance);
  EXPECT_LT((e.tail<3>() - psi / h).norm(), tolerance);
  EXPECT_NEAR(helical_rotation(z), GetParam(), tolerance);
}

TEST_P(HelicalStrain, GradientIsItsDerivative) {
  const auto difference =
      central_difference<6, 7>([](const Vec<7>& at) { return helical_strain(at, h); }, z);
  EXPECT_LT(relative_difference(difference, helical_strain_gradient(z, h)), 2e-9);
}

TEST_P(HelicalStrain, HessianIsDerivativeOfWeightedGradient) {
  const auto weighted = weigh_helical_strain(z, w, h);
  EXPECT_LT(
      relative_difference(weighted.gradient, Vec<7>(helical_strain_gradient(z, h).transpose() * w)),
      1e-14);
  const auto difference = central_difference<7, 7>(
      [&](const Vec<7>& at) { return weigh_helical_strain(at, w, h).gradient; }, z, 1e-5);
  EXPECT_LT(relative_difference(difference, weighted.hessian), GetParam() < 2.0 ? 1e-9 : 1e-6);
  EXPECT_LT((weighted.hessian - weighted.hessian.transpose()).norm(),
            1e-14 * (1.0 + weighted.hessian.norm()));
}

TEST_P(HelicalStrain, IncrementIsTheDifference) {
  for (const double size : {0.3, 0.03, 0.003}) {
    const Vec<7> z1 = invariants(psi * (1.0 - size) + size * Vec3(0.1, 0.2, 0.0), r + size * r);
    const Vec6 plain = helical_strain(z1, h) - helical_strain(z, h);
    EXPECT_LT((helical_strain_increment(z, z1, h) - plain).norm(), 1e-13) << size;
  }
}

TEST_P(HelicalStrain, IncrementKeepsItsDigitsInSmallSteps) {
  const Vec<7> direction = kit::Random(2).matrix<7, 1>();
  for (const double size : {1e-6, 1e-9, 1e-12}) {
    const Vec<7> z1 = z + size * direction;
    const Vec<7> mid = 0.5 * (z + z1);
    const Vec6 linear = helical_strain_gradient(mid, h) * (z1 - z);
    // the rest is of third order in the step
    const double rest = 1e-15 + (GetParam() < 2.5 ? 10.0 : 1e4) * size * size;
    EXPECT_LT(relative_difference(helical_strain_increment(z, z1, h), linear), 10.0 * rest);
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, HelicalStrain,
                         testing::Values(0.0, 1e-9, 1e-4, 0.1, 0.444, 0.451, 0.46, 1.5, 2.4, 2.9));

TEST(HelicalStrainSeries, MeetsTheClosedFormAtTheSwitch) {
  // angle_by_sine changes formula at c = 0.9
  const double angle = std::acos(0.9);
  const Vec3 axis = Vec3(0.3, -0.7, 0.5).normalized();
  const Vec6 w = kit::Random(1).matrix<6, 1>();
  const auto below = weigh_helical_strain(invariants((angle - 1e-13) * axis, axis), w, h);
  const auto above = weigh_helical_strain(invariants((angle + 1e-13) * axis, axis), w, h);
  EXPECT_LT((below.gradient - above.gradient).norm(), 1e-12);
  EXPECT_LT((below.hessian - above.hessian).norm(), 1e-12);
}

}  // namespace
}  // namespace culm::beam
