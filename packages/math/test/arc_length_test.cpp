#include <culm/math/arc_length.hpp>
#include <culm/math/lagrange.hpp>
#include <culm/math/quadrature.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace culm {
namespace {

// Nodes on a straight line.
constexpr double positions[] = {0.0, 0.35, 1.0};

double place(double xi) {
  const auto N = Lagrange<2>::values(xi);
  return N[0] * positions[0] + N[1] * positions[1] + N[2] * positions[2];
}

std::vector<double> shares_of_element() {
  std::vector<double> shares;
  for (const auto& [xi, weight] : gauss_legendre(3)) {
    const auto dN = Lagrange<2>::derivatives(xi);
    shares.push_back(weight * (dN[0] * positions[0] + dN[1] * positions[1] + dN[2] * positions[2]));
  }
  return shares;
}

TEST(ArcLength, IsThatOfTheInterpolatedLine) {
  const std::vector<double> shares = shares_of_element();
  const ArcLength along(shares);
  EXPECT_NEAR(along.length(), 1.0, 1e-15);
  for (double xi : {-1.0, -0.7, 0.0, 0.2, 0.9, 1.0}) {
    EXPECT_NEAR(along.at(xi), place(xi), 1e-15);
    EXPECT_NEAR(along.xi_at(place(xi)), xi, 1e-14);
    EXPECT_NEAR(along.rate(xi), (place(xi + 1e-4) - place(xi - 1e-4)) / 2e-4, 1e-10);
  }
}

TEST(ArcLength, OfEvenNodesIsLinear) {
  const std::vector<double> shares = {0.5, 0.5};
  const ArcLength along(shares);
  EXPECT_EQ(along.xi_at(0.25), -0.5);
  EXPECT_EQ(along.at(-0.5), 0.25);
  EXPECT_EQ(along.rate(0.3), 0.5);
}

TEST(ArcLength, EndsAtTheEnds) {
  const std::vector<double> shares = shares_of_element();
  const ArcLength along(shares);
  EXPECT_EQ(along.xi_at(-0.1), -1.0);
  EXPECT_EQ(along.xi_at(1.1), 1.0);
}

}  // namespace
}  // namespace culm
