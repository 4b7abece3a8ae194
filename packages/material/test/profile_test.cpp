#include <culm/material/box_section.hpp>
#include <culm/material/circle_section.hpp>
#include <culm/material/rectangle_section.hpp>
#include <culm/material/tube_section.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace culm::material {
namespace {

constexpr double poisson_ratio = 0.3;

// int f dA over a ring, by the midpoint rule in the radius and the trapezoidal rule around.
double over_ring(double inner, double outer, const std::function<double(double, double)>& f) {
  constexpr int rings = 2000;
  constexpr int around = 16;
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double r = inner + (outer - inner) * (i + 0.5) / rings;
    for (int j = 0; j < around; ++j) {
      const double angle = 2.0 * std::numbers::pi * j / around;
      sum += r * f(r * std::cos(angle), r * std::sin(angle));
    }
  }
  return sum * (outer - inner) / rings * 2.0 * std::numbers::pi / around;
}

TEST(CircleShape, HasTheMomentsOfItsArea) {
  const Profile circle = CircleSection::profile(0.7, poisson_ratio);
  EXPECT_NEAR(circle.area, over_ring(0.0, 0.7, [](double, double) { return 1.0; }), 1e-12);
  EXPECT_NEAR(circle.I1, over_ring(0.0, 0.7, [](double, double y) { return y * y; }), 1e-7);
  EXPECT_NEAR(circle.I2, over_ring(0.0, 0.7, [](double x, double) { return x * x; }), 1e-7);
  EXPECT_NEAR(circle.torsion, circle.I1 + circle.I2, 1e-15);
}

TEST(TubeShape, HasTheMomentsOfItsArea) {
  const Profile tube = TubeSection::profile(0.7, 0.2, poisson_ratio);
  EXPECT_NEAR(tube.area, over_ring(0.5, 0.7, [](double, double) { return 1.0; }), 1e-12);
  EXPECT_NEAR(tube.I1, over_ring(0.5, 0.7, [](double, double y) { return y * y; }), 1e-8);
  EXPECT_NEAR(tube.torsion, tube.I1 + tube.I2, 1e-15);
}

TEST(TubeShape, FilledIsTheCircle) {
  const Profile tube = TubeSection::profile(0.7, 0.7, poisson_ratio);
  const Profile circle = CircleSection::profile(0.7, poisson_ratio);
  EXPECT_NEAR(tube.area, circle.area, 1e-15);
  EXPECT_NEAR(tube.I1, circle.I1, 1e-15);
  EXPECT_NEAR(tube.k1, circle.k1, 1e-15);
}

// Cowper (1966): solid circle 0.886, thin tube 2 (1 + nu) / (4 + 3 nu) = 0.531, rectangle 0.850,
// thin square tube 20 (1 + nu) / (48 + 39 nu) = 0.436, all for nu = 0.3
TEST(ShearFactors, AreCowpers) {
  EXPECT_NEAR(CircleSection::profile(1.0, poisson_ratio).k1, 0.886, 5e-4);
  EXPECT_NEAR(TubeSection::profile(1.0, 1e-6, poisson_ratio).k2, 0.531, 5e-4);
  EXPECT_NEAR(RectangleSection::profile(1.0, 2.0, poisson_ratio).k1, 0.850, 5e-4);
  const Profile square = BoxSection::profile({1.0, 1.0, 1e-6, 1e-6}, poisson_ratio);
  EXPECT_NEAR(square.k1, 0.436, 5e-4);
  EXPECT_EQ(square.k1, square.k2);
}

TEST(ShearFactors, OfABoxFollowTheWallsAlongTheForce) {
  // hardly any flange: only the webs are left, and they shear like a rectangle along d2
  const Profile box = BoxSection::profile({0.1, 1.0, 1e-6, 1e-3}, poisson_ratio);
  EXPECT_NEAR(box.k2, 10.0 * (1.0 + poisson_ratio) / (12.0 + 11.0 * poisson_ratio), 1e-3);
  EXPECT_LT(box.k1, 0.01);
}

// Timoshenko, Goodier (1970), section 109, table of k_1: torsion constant / (a b^3)
TEST(RectangleShape, HasTheTabulatedTorsionConstant) {
  const std::pair<double, double> table[] = {{1.0, 0.1406}, {1.2, 0.166}, {1.5, 0.196},
                                             {2.0, 0.229},  {2.5, 0.249}, {3.0, 0.263},
                                             {4.0, 0.281},  {5.0, 0.291}, {10.0, 0.312}};
  for (const auto& [ratio, factor] : table) {
    const double b = 0.3;
    const double tolerance = ratio == 1.0 ? 5e-5 : 6e-4;
    EXPECT_NEAR(
        RectangleSection::profile(ratio * b, b, poisson_ratio).torsion / (ratio * b * b * b * b),
        factor, tolerance);
    EXPECT_NEAR(
        RectangleSection::profile(b, ratio * b, poisson_ratio).torsion / (ratio * b * b * b * b),
        factor, tolerance);
  }
}

TEST(RectangleShape, NamesItsMomentsByTheAxisTheyAreAbout) {
  const Profile plank = RectangleSection::profile(3.0, 0.2, poisson_ratio);  // flat: weak about d1
  EXPECT_NEAR(plank.I1, 3.0 * 0.2 * 0.2 * 0.2 / 12.0, 1e-15);
  EXPECT_NEAR(plank.I2, 0.2 * 27.0 / 12.0, 1e-15);
  EXPECT_NEAR(plank.area, 0.6, 1e-15);
}

TEST(BoxShape, IsTheOuterMinusTheInnerRectangle) {
  const Profile box = BoxSection::profile({3.0, 2.0, 0.1, 0.2}, poisson_ratio);
  const Profile outer = RectangleSection::profile(3.0, 2.0, poisson_ratio);
  const Profile inner = RectangleSection::profile(2.6, 1.8, poisson_ratio);
  EXPECT_NEAR(box.area, outer.area - inner.area, 1e-14);
  EXPECT_NEAR(box.I1, outer.I1 - inner.I1, 1e-14);
  EXPECT_NEAR(box.I2, outer.I2 - inner.I2, 1e-14);
}

TEST(BoxShape, ThinSquareHasBredtsTorsionConstant) {
  EXPECT_NEAR(BoxSection::profile({1.0, 1.0, 1e-6, 1e-6}, poisson_ratio).torsion / 1e-6, 1.0, 1e-5);
}

TEST(Outlines, RunCounterClockwise) {
  for (const auto& outline : {circle_outline(0.5), rectangle_outline(0.4, 0.2)}) {
    double twice_area = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const auto& a = outline[i];
      const auto& b = outline[(i + 1) % outline.size()];
      twice_area += a[0] * b[1] - a[1] * b[0];
    }
    EXPECT_GT(twice_area, 0.0);
  }
}

}  // namespace
}  // namespace culm::material
