#include <culm/soil/api_curves.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace culm::soil {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

TEST(Sand, CoefficientsAreThoseOfTheFormulas) {
  const auto c35 = SandCoefficients::of(35.0 * degree);
  EXPECT_NEAR(c35.C1, 2.97045, 5e-6);
  EXPECT_NEAR(c35.C2, 3.41918, 5e-6);
  EXPECT_NEAR(c35.C3, 53.79345, 5e-6);
  const auto c30 = SandCoefficients::of(30.0 * degree);
  EXPECT_NEAR(c30.C1, 1.91170, 5e-6);
  EXPECT_NEAR(c30.C2, 2.66667, 5e-6);
  EXPECT_NEAR(c30.C3, 28.74513, 5e-6);
}

TEST(Sand, ResistsAsTheFormulaSays) {
  const Sand sand{35.0 * degree, 10e3, 22e6};
  EXPECT_NEAR(SandCurve::ultimate(sand, 10.0, 6.0), 5021.957e3, 1.0);
  const SandCurve curve(sand, 10.0, 6.0, false);
  EXPECT_NEAR(curve.force(0.01), 2150.698e3, 1.0);
  EXPECT_NEAR(curve.force(0.05), 7242.846e3, 1.0);
  EXPECT_NEAR(SandCurve(sand, 10.0, 6.0, true).force(1e3), 0.9 * 5021.957e3, 1.0);
}

const Clay clay{50e3, 8e3, 0.01, 0.5};

TEST(Clay, ResistsAsTheFormulaSays) {
  const double D = 2.0, X = 3.0, yc = 2.5 * 0.01 * D;
  const double pu = (3.0 * 50e3 + 8e3 * X + 0.5 * 50e3 * X / D) * D;
  EXPECT_NEAR(ClayCurve::ultimate(clay, X, D), pu, 1e-9 * pu);
  EXPECT_NEAR(ClayCurve::ultimate(clay, 100.0, D), 9.0 * 50e3 * D, 1e-6);
  const ClayCurve curve(clay, X, D, false);
  EXPECT_NEAR(curve.force(yc), 0.5 * pu, 1e-9 * pu);
  EXPECT_NEAR(curve.force(8.0 * yc), pu, 1e-9 * pu);
  EXPECT_NEAR(curve.force(-20.0 * yc), -pu, 1e-9 * pu);
  EXPECT_NEAR(curve.slope(0.0), curve.force(0.1 * yc) / (0.1 * yc), 1e-9 * curve.slope(0.0));
}

TEST(Clay, LosesStrengthUnderCyclicLoads) {
  const double D = 2.0, yc = 2.5 * 0.01 * D;
  const double XR = 6.0 * D / (8e3 * D / 50e3 + 0.5);
  const ClayCurve shallow(clay, 0.25 * XR, D, true);
  const double pu = ClayCurve::ultimate(clay, 0.25 * XR, D);
  EXPECT_NEAR(shallow.force(3.0 * yc), 0.72 * pu, 2e-3 * pu);
  EXPECT_NEAR(shallow.force(15.0 * yc), 0.25 * 0.72 * pu, 1e-9 * pu);
  EXPECT_NEAR(shallow.force(30.0 * yc), 0.25 * 0.72 * pu, 1e-9 * pu);
  const ClayCurve deep(clay, 2.0 * XR, D, true);
  EXPECT_NEAR(deep.force(30.0 * yc), 0.72 * ClayCurve::ultimate(clay, 2.0 * XR, D), 1e-6);
}

std::vector<SharedCurve> curves() {
  const Sand sand{35.0 * degree, 10e3, 22e6};
  const ShaftTable shaft = clay_shaft(2.0, 0.8);
  return {
      std::make_shared<SandCurve>(sand, 10.0, 6.0, false),
      std::make_shared<ClayCurve>(clay, 3.0, 2.0, false),
      std::make_shared<ClayCurve>(clay, 3.0, 2.0, true),
      std::make_shared<TableCurve>(shaft.displacements, shaft.fractions, TableCurve::Sides::both),
      std::make_shared<TableCurve>(shaft.displacements, shaft.fractions,
                                   TableCurve::Sides::positive),
      std::make_shared<LinearCurve>(3.0)};
}

// Slope and force are derivatives of force and potential, except at corners.
TEST(Curves, AreDerivativesOfTheirPotential) {
  for (const SharedCurve& curve : curves()) {
    for (const double y : {-0.31, -0.0207, -0.0021, 0.0013, 0.0233, 0.0611, 0.337, 1.9}) {
      const double h = 1e-6 * std::abs(y);
      const double scale = 1e-6 * std::abs(curve->force(0.3));
      EXPECT_NEAR((curve->energy(y + h) - curve->energy(y - h)) / (2.0 * h), curve->force(y),
                  scale);
      EXPECT_NEAR((curve->force(y + h) - curve->force(y - h)) / (2.0 * h), curve->slope(y),
                  1e-6 * curve->slope(0.0) + scale);
    }
  }
}

// The mean times the way is the change of the potential, near and far, and its derivative right.
TEST(Curves, HaveExactMeans) {
  for (const SharedCurve& curve : curves()) {
    for (const double from : {-0.4, 0.0, 0.0037, 0.11}) {
      for (const double way : {1e-9, 1e-6, -2e-3, 0.05, -0.7}) {
        const double to = from + way;
        const double change = curve->energy(to) - curve->energy(from);
        EXPECT_NEAR(curve->mean(from, to).value * way, change,
                    1e-13 * (curve->energy(to) + curve->energy(from)));
        if (std::abs(way) < 1e-4) continue;
        const double h = 1e-4 * std::abs(way);
        const double slope =
            (curve->mean(from, to + h).value - curve->mean(from, to - h).value) / (2.0 * h);
        EXPECT_NEAR(curve->mean(from, to).derivative, slope, 1e-4 * curve->slope(1e-6));
      }
    }
  }
}

// Near zero a curve is a line, and its mean the half sum of the forces, however small the way.
TEST(Curves, KeepTheDigitsOfSmallMeans) {
  for (const SharedCurve& curve : curves()) {
    for (const double y : {1e-7, 1e-9, 1e-12}) {
      for (const double to : {0.0, 0.5 * y, 3.0 * y}) {
        const double mean = 0.5 * (curve->force(y) + curve->force(to));
        EXPECT_NEAR(curve->mean(y, to).value, mean, 1e-10 * mean);
      }
    }
  }
}

}  // namespace
}  // namespace culm::soil
