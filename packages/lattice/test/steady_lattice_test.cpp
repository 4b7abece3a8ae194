#include "lattice_kit.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace culm::lattice {
namespace {

constexpr LatticeSetting without_core{.core = {.width = 0.0}};

double slope(const kit::Wing& wing, Panels panels) {
  return kit::lift_slope(wing, panels, without_core);
}

using kit::Wing;

Wing rectangle(double aspect_ratio, bool inset) {
  return {.half_span = 0.5 * aspect_ratio, .inset = inset};
}

// The same lattices computed by an independent program; figures to four digits.
TEST(SteadyLattice, RectangularWings) {
  for (const auto& [aspect, plain, inset] :
       {std::array{4.0, 3.7069, 3.6108}, std::array{8.0, 4.6903, 4.5843},
        std::array{12.0, 5.1266, 5.0193}, std::array{20.0, 5.5348, 5.4296}}) {
    EXPECT_NEAR(slope(rectangle(aspect, false), {4, 13}), plain, 2e-4) << aspect;
    EXPECT_NEAR(slope(rectangle(aspect, true), {8, 26}), inset, 1e-3 * inset) << aspect;
  }
}

TEST(SteadyLattice, InsetTipsMakeTheSpanConvergeAtSecondOrder) {
  const double converged = 3.6093;
  EXPECT_NEAR(slope(rectangle(4.0, true), {4, 6}), converged, 0.0035 * converged);
  EXPECT_NEAR(slope(rectangle(4.0, true), {4, 13}), converged, 0.0008 * converged);
  EXPECT_NEAR(slope(rectangle(4.0, false), {4, 6}), 3.8143, 2e-4);
}

TEST(SteadyLattice, SweptWing) {
  const auto wing = [](bool inset) {
    return Wing{.half_span = 2.5, .sweep = std::numbers::pi / 4.0, .inset = inset};
  };
  EXPECT_NEAR(slope(wing(false), {1, 4}), 3.4442, 2e-4);
  EXPECT_NEAR(slope(wing(false), {4, 16}), 3.2509, 2e-4);
  EXPECT_NEAR(slope(wing(true), {8, 32}), 3.1863, 1e-3 * 3.1863);
}

// Lifting-surface theory is 6 % below the lifting line here.
TEST(SteadyLattice, EllipticalWing) {
  const Wing wing{.half_span = 2.5, .inset = false, .elliptical = true};
  EXPECT_NEAR(slope(wing, {4, 40}) * 5.7106 * std::numbers::pi / 180.0, 0.4475, 1e-3);
}

TEST(SteadyLattice, TwoDimensionalLimit) {
  EXPECT_NEAR(slope(rectangle(1e5, false), {4, 1}), 2.0 * std::numbers::pi, 1e-3);
}

TEST(SteadyLattice, MirrorStandsForTheOtherHalf) {
  const Panels half{4, 6}, whole{4, 12};
  const Wing wing = rectangle(5.0, false);
  Points both;
  for (int i = 0; i <= 4; ++i) {
    for (int j = 0; j <= 12; ++j) both.push_back({i / 4.0, 2.5 * (j - 6) / 6.0, 0.0});
  }
  const auto air = std::make_shared<kit::Wind>(Vec3(1.0, 0.0, 0.1));
  const Lattice full(BoundLattice({whole}, both, std::nullopt), air, {});
  const Lattice mirrored(BoundLattice({half}, kit::grid(wing, half), Vec3(0.0, 1.0, 0.0)), air, {});
  const Vec3 all = kit::total(full.steady(both, 0.0).forces);
  const Vec3 one = kit::total(mirrored.steady(kit::grid(wing, half), 0.0).forces);
  EXPECT_NEAR(all.x(), 2.0 * one.x(), 1e-8);
  EXPECT_NEAR(all.y(), 0.0, 1e-8);
  EXPECT_NEAR(all.z(), 2.0 * one.z(), 1e-8);
}

// Suction makes the force of a flat plate in plane flow normal to the wind, and pressures do not.
TEST(SteadyLattice, ForceRulesDifferBySuctionAlone) {
  const Wing wing = rectangle(1e5, false);
  const double alpha = 0.1;
  const auto drag_and_lift = [&](ForceRule rule) {
    const Lattice lattice =
        kit::make(wing, {8, 1}, alpha, {.forces = rule, .core = {.width = 0.0}});
    const Vec3 f = kit::total(lattice.steady(kit::grid(wing, {8, 1}), 0.0).forces);
    return std::pair(f.x() * std::cos(alpha) + f.z() * std::sin(alpha),
                     f.z() * std::cos(alpha) - f.x() * std::sin(alpha));
  };
  const auto [drag, lift] = drag_and_lift(ForceRule::joukowski);
  const auto [pressure_drag, pressure_lift] = drag_and_lift(ForceRule::bernoulli);
  EXPECT_NEAR(drag / lift, 0.0, 1e-4);
  EXPECT_NEAR(pressure_drag / pressure_lift, std::tan(alpha), 1e-6);
  EXPECT_NEAR(pressure_lift / (lift * std::cos(alpha) * std::cos(alpha)), 1.0, 1e-4);
}

// Two half surfaces that touch are one.
TEST(SteadyLattice, SurfacesThatTouchAreOne) {
  Points parts, whole;
  for (const int start : {0, 3}) {
    for (int i = 0; i <= 2; ++i) {
      for (int j = 0; j <= 3; ++j) parts.push_back({0.5 * i, 1.0 * (start + j), 0.0});
    }
  }
  for (int i = 0; i <= 2; ++i) {
    for (int j = 0; j <= 6; ++j) whole.push_back({0.5 * i, 1.0 * j, 0.0});
  }
  const auto air = std::make_shared<kit::Wind>(Vec3(1.0, 0.2, 0.1));
  const Lattice two(BoundLattice({{2, 3}, {2, 3}}, parts, std::nullopt), air, {});
  const Lattice one(BoundLattice({{2, 6}}, whole, std::nullopt), air, {});
  const Vec3 difference =
      kit::total(two.steady(parts, 0.0).forces) - kit::total(one.steady(whole, 0.0).forces);
  EXPECT_NEAR(difference.norm(), 0.0, 1e-6);
}

}  // namespace
}  // namespace culm::lattice
