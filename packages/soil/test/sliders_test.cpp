#include <culm/soil/api_curves.hpp>
#include <culm/soil/sliders.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace culm::soil {
namespace {

const SandCurve sand_curve({0.6, 10e3, 22e6}, 5.0, 2.0, false);
const ClayCurve clay_curve({40e3, 8e3, 0.01, 0.5}, 5.0, 2.0, false);

/// Force along x after a list of places, each one step.
struct Path {
  std::vector<Slider> sliders;
  std::vector<Vec3> slips;
  Vec3 place = Vec3::Zero();
  double work = 0.0, slid = 0.0, force = 0.0;

  explicit Path(const Curve& curve) : sliders(*sliders_of(curve)), slips(sliders.size()) {
    slips.assign(sliders.size(), Vec3::Zero());
  }
  void go(const Vec3& next) {
    std::vector<Vec3> trial = slips;
    force = slide(sliders, place, next, 1.0, trial).force[0];
    const SliderResponse step = slide(sliders, place, next, 0.5, slips);
    EXPECT_GE(step.slid, 0.0);
    work += step.force.dot(next - place);
    slid += step.slid;
    place = next;
  }
};

TEST(Sliders, FirstLoadingFollowsTheCurve) {
  for (const Curve* curve :
       {static_cast<const Curve*>(&sand_curve), static_cast<const Curve*>(&clay_curve)}) {
    const double end = curve->knots().back();
    for (const double share : {0.003, 0.02, 0.1, 0.4, 0.9, 3.0}) {
      Path path(*curve);
      path.go(share * end * Vec3::UnitX());
      EXPECT_NEAR(path.force, curve->force(share * end), 0.01 * curve->force(end)) << share;
    }
  }
}

// After a turn at y1 the force is that there less twice the curve at half of the way back.
TEST(Sliders, LoopsAreThoseOfMasing) {
  const std::vector<double> knots = sand_curve.knots();
  Path path(sand_curve);
  const double y = knots[12];
  path.go(y * Vec3::UnitX());
  const double turn = path.force;
  for (const double back : {knots[2], knots[7], knots[12]}) {
    Path one = path;
    one.go((y - 2.0 * back) * Vec3::UnitX());
    EXPECT_NEAR(one.force, turn - 2.0 * sand_curve.force(back), 1e-9 * turn);
  }
}

TEST(Sliders, WorkIsStoredOrSlid) {
  Path path(clay_curve);
  for (int i = 1; i <= 200; ++i) {
    const double angle = 0.31 * i;
    path.go(0.05 * std::sin(0.1 * i) * Vec3(std::cos(angle), std::sin(angle), 0.0));
    EXPECT_NEAR(path.work, path.slid + energy_of(path.sliders, path.place, path.slips),
                1e-12 * path.work);
  }
  EXPECT_GT(path.slid, 0.5 * path.work);
}

// The elastic way is then a small difference of large slips.
TEST(Sliders, SoilThatHasSlidFarIsElasticAboutItsState) {
  for (const double way : {0.5, 3.0, 40.0}) {
    Path path(sand_curve);
    path.go(way * Vec3(0.6, 0.8, 0.0));
    std::vector<Vec3> slips = path.slips;
    const SliderResponse about = slide(path.sliders, path.place, path.place, 1.0, slips);
    double stiffness = 0.0;
    for (const Slider& slider : path.sliders) stiffness += slider.stiffness;
    EXPECT_LT((about.derivative - stiffness * Mat3::Identity()).norm(), 1e-12 * stiffness) << way;
  }
}

TEST(Sliders, LinesNeverSlide) {
  Path path(LinearCurve(3.0));
  path.go(7.0 * Vec3::UnitX());
  EXPECT_EQ(path.force, 21.0);
  EXPECT_EQ(path.slid, 0.0);
}

TEST(Sliders, CurvesThatFallHaveNone) {
  EXPECT_FALSE(sliders_of(ClayCurve({40e3, 8e3, 0.01, 0.5}, 1.0, 2.0, true)).has_value());
  EXPECT_FALSE(sliders_of(TableCurve({0.0, 1.0, 2.0}, {0.0, 1.0, 3.0}, TableCurve::Sides::both)));
}

TEST(Sliders, TangentIsDerivativeOfTheForce) {
  Path path(sand_curve);
  path.go(Vec3(0.01, -0.004, 0.0));
  const Vec3 next(-0.003, 0.006, 0.0);
  for (const double theta : {0.5, 1.0}) {
    const auto force = [&](const Vec3& to) {
      std::vector<Vec3> slips = path.slips;
      return slide(path.sliders, path.place, to, theta, slips);
    };
    Mat3 difference;
    for (int i = 0; i < 3; ++i) {
      const Vec3 h = 1e-8 * Vec3::Unit(i);
      difference.col(i) = (force(next + h).force - force(next - h).force) / 2e-8;
    }
    EXPECT_LT((force(next).derivative - difference).norm(), 1e-6 * difference.norm());
  }
}

}  // namespace
}  // namespace culm::soil
