// What the elements make of a beam with constant strain, whose axis is a helix. Exact for the
// helical element; the director elements show their order. @source formulation 1.3.4, 1.3.5

#include "beam_case.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace culm::beam {
namespace {

// Node of a beam with constant absolute strain (Γ, K) at arc length s: the exponential of the
// motion, x = int_0^s exp(s K) Γ ds.
Slots<4> on_helix(const Vec3& Gamma, const Vec3& K, double s) {
  const double k = K.norm();
  const Mat3 W = skew(K);
  Mat3 V = s * Mat3::Identity();
  if (k > 0.0) {
    const double sh = std::sin(0.5 * k * s);
    V += 2.0 * sh * sh / (k * k) * W + (k * s - std::sin(k * s)) / (k * k * k) * W * W;
  }
  Slots<4> node;
  node << V * Gamma, exp_rotation(s * K);
  return node;
}

template <int Nodes>
Slots<4 * Nodes> element_on_helix(const Vec3& Gamma, const Vec3& K, double h) {
  Slots<4 * Nodes> q;
  for (int a = 0; a < Nodes; ++a) {
    q.template middleCols<4>(4 * a) = on_helix(Gamma, K, h * a / (Nodes - 1));
  }
  return q;
}

const Vec3 straight(0.0, 0.0, 1.0);

TEST(HelicalBeamAccuracy, ConstantStrainIsExact) {
  const Vec3 K_reference(0.4, -0.2, 0.3);
  const double h = 1.3;
  const HelicalBeam element(element_on_helix<2>(straight, K_reference, h), Mat6::Identity(),
                            {Mat3::Identity(), Mat3::Identity()});
  EXPECT_NEAR(element.length(), h, 1e-14);
  EXPECT_LT((element.reference_strain().tail<3>() - K_reference).norm(), 1e-14);
  const Vec3 Gamma(0.05, -0.1, 1.2);
  for (const Vec3& K : {Vec3(0.0, 0.0, 0.0), Vec3(1e-7, 0.0, 2e-7), Vec3(0.5, -0.1, 0.3),
                        Vec3(1.5, 0.6, -0.9), Vec3(0.0, 2.1, 0.0)}) {
    Vec<7> y;
    element.strain(0, element_on_helix<2>(Gamma, K, h), y);
    const Vec6 e = element.section_strain(y);
    EXPECT_LT((e.head<3>() - (Gamma - straight)).norm(), 1e-13) << K.transpose();
    EXPECT_LT((e.tail<3>() - (K - K_reference)).norm(), 1e-13) << K.transpose();
  }
}

TEST(HelicalBeamAccuracy, RollUpHasTheContinuumMomentForAnyElementLength) {
  // M = EI K holds exactly: three elements make a circle
  const double h = 1.0;
  const double angle = 2.0 * std::acos(-1.0) / 3.0;
  Mat6 C = Mat6::Identity();
  C(3, 3) = 7.0;
  const HelicalBeam element(element_on_helix<2>(straight, Vec3::Zero(), h), C,
                            {Mat3::Identity(), Mat3::Identity()});
  Vec<7> y;
  element.strain(0, element_on_helix<2>(straight, angle / h * Vec3::UnitX(), h), y);
  const Vec6 expected = Vec6::Unit(3) * 7.0 * angle / h;
  EXPECT_LT((element.resultants(0, y) - expected).norm(), 1e-13);
}

TEST(DirectorBeamAccuracy, TwoNodesSeeTheSineOfTheElementAngle) {
  const double h = 0.8;
  const DirectorBeam<1> element(element_on_helix<2>(straight, Vec3::Zero(), h), {Mat6::Identity()},
                                {Mat3::Identity(), Mat3::Identity()});
  for (const double angle : {0.1, 0.7, 1.4}) {
    Vec6 e;
    element.strain(0, element_on_helix<2>(straight, Vec3(angle / h, 0.0, 0.0), h), e);
    EXPECT_NEAR(e[3], std::sin(angle) / h, 1e-15);
    // chord 2 h sin(angle/2) / angle seen by directors of length cos(angle/2)
    EXPECT_NEAR(e[2], std::sin(angle) / angle - 1.0, 1e-15);
  }
}

// Largest strain error of an element of length h on the helix, over the Gauss points.
template <int Order>
double helix_error(double h) {
  std::array<Mat6, Order> C;
  C.fill(Mat6::Identity());
  std::array<Mat3, Order + 1> m;
  m.fill(Mat3::Identity());
  const DirectorBeam<Order> element(element_on_helix<Order + 1>(straight, Vec3::Zero(), h), C, m);
  const Vec3 Gamma(0.05, -0.1, 1.2);
  const Vec3 K(0.5, -0.3, 0.4);
  Vec6 exact;
  exact << Gamma - straight, K;
  double error = 0.0;
  for (int g = 0; g < Order; ++g) {
    Vec6 e;
    element.strain(g, element_on_helix<Order + 1>(Gamma, K, h), e);
    error = std::max(error, (e - exact).cwiseAbs().maxCoeff());
  }
  return error;
}

template <int Order>
double observed_order() {
  return std::log2(helix_error<Order>(0.4) / helix_error<Order>(0.2));
}

TEST(DirectorBeamAccuracy, StrainErrorOfOrderOneIsQuadratic) {
  EXPECT_NEAR(observed_order<1>(), 2.0, 0.02);
}
TEST(DirectorBeamAccuracy, StrainErrorOfOrderTwoIsCubic) {
  EXPECT_NEAR(observed_order<2>(), 3.0, 0.02);
}
// For cubics on equidistant nodes the Gauss points are no better than other points; for quadratics
// they are.
TEST(DirectorBeamAccuracy, StrainErrorOfOrderThreeIsCubicToo) {
  EXPECT_NEAR(observed_order<3>(), 3.0, 0.1);
}

}  // namespace
}  // namespace culm::beam
