#include "../src/tower_bending.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace culm::openfast {
namespace {

constexpr double EI = 3e9;
constexpr double m = 500.0;
constexpr double L = 40.0;

Cantilever uniform(double tip_mass = 0.0) {
  return {L, {0.0, 1.0}, [](double) { return m; }, [](double) { return EI; }, tip_mass};
}

// (beta L)^2 sqrt(EI / m L^4)
double omega(double beta_L, double length = L) {
  return beta_L * beta_L * std::sqrt(EI / (m * std::pow(length, 4)));
}

TEST(FirstBending, OfAUniformBeam) {
  EXPECT_NEAR(first_bending(uniform()) / omega(1.87510407), 1.0, 1e-6);
  EXPECT_NEAR(first_bending(uniform(), FloatingBase{}) / omega(4.73004074), 1.0, 1e-6);
  EXPECT_NEAR(first_bending(extended(uniform(), 10.0)) / omega(1.87510407, L + 10.0), 1.0, 1e-6);
}

TEST(FirstBending, OfALightBeamIsThatOfItsTipMass) {
  const double mass = 1e4 * m * L;
  EXPECT_NEAR(first_bending(uniform(mass)) / std::sqrt(3.0 * EI / (mass * std::pow(L, 3))), 1.0,
              1e-4);
}

TEST(FirstBending, OnAHeavyPlatformIsThatOfTheClampedBeam) {
  const FloatingBase heavy{1e9, 1e12, 0.0};
  EXPECT_NEAR(first_bending(uniform(1e5), heavy) / first_bending(uniform(1e5)), 1.0, 1e-3);
}

// Two bodies and a light beam: 3 EI / L^3 (1 / M + 1 / m + (L + d)^2 / I)
TEST(FirstBending, TheCentreOfThePlatformCounts) {
  const double tip = 1e4 * m * L;
  const FloatingBase body{1.5 * tip, 2000.0 * tip, 30.0};
  const double compliance =
      1.0 / tip + 1.0 / body.mass + (L + body.depth) * (L + body.depth) / body.inertia;
  EXPECT_NEAR(first_bending(uniform(tip), body) / std::sqrt(3.0 * EI / (L * L * L) * compliance),
              1.0, 1e-3);
}

}  // namespace
}  // namespace culm::openfast
