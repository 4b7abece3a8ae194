#include "morison_kit.hpp"

#include <cmath>
#include <numbers>

namespace culm::water {
namespace {

using std::numbers::pi;
constexpr double weight = 1025.0 * 9.80665;  // of the water per volume

using test::member;
using test::MovedMember;
using test::segment;
using test::still_water;

Mat3 tilted(double angle) { return Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix(); }

WetSection pipe(double diameter) {
  WetSection section;
  section.diameter = diameter;
  return section;
}

// The hull of the OC3 spar. @source fluids C18
TEST(Buoyancy, OfATaperedHull) {
  std::vector<Segment> hull = {segment({0, 0, -120}, {0, 0, -12}, 9.4, 9.4),
                               segment({0, 0, -12}, {0, 0, -4}, 9.4, 6.5),
                               segment({0, 0, -4}, {0, 0, 10}, 6.5, 6.5)};
  MovedMember spar(hull, still_water(320.0));
  const auto found = spar.stand(MovedMember::placed({3.0, 0.0, 0.0}, Mat3::Identity()));
  EXPECT_NEAR(found.force[2] / weight, 8029.2092, 5e-5);
  EXPECT_NEAR(found.force[2], 80708136.0, 0.5);
  EXPECT_NEAR(found.force.head<2>().norm(), 0.0, 1e-6);
  EXPECT_NEAR(-found.moment[1] / found.force[2], 3.0, 1e-12);
}

// Radius 2 m, tilted by 30 degrees, the axis wet over 10 m of depth. @source fluids C18
TEST(Buoyancy, OfAnInclinedCylinderThatTheSurfaceCuts) {
  const double tilt = pi / 6.0;
  for (const int count : {1, 2, 7, 20}) {
    MovedMember pile(member(Vec3::Zero(), {0, 0, 20}, pipe(4.0), pipe(4.0), count), still_water());
    const auto found = pile.stand(MovedMember::placed({0.0, 0.0, -10.0}, tilted(tilt)));
    EXPECT_NEAR(found.force[2] / weight, 145.10395, 5e-6);
    EXPECT_NEAR(found.force.head<2>().norm(), 0.0, 1e-7);
    // centre 5.787936 m along the axis, 0.05 m beside it towards the underside
    const double x = 5.787936 * std::sin(tilt) + 0.05 * std::cos(tilt);
    EXPECT_NEAR(-found.moment[1] / found.force[2], x, 1e-6);
  }
}

TEST(Buoyancy, OfAnUprightCylinderIsThatOfATiltThatVanishes) {
  MovedMember pile(member(Vec3::Zero(), {0, 0, 20}, pipe(4.0), pipe(4.0), 3), still_water());
  for (const double tilt : {1e-6, 2e-5, 1e-3}) {
    const auto found = pile.stand(MovedMember::placed({0.0, 0.0, -10.0}, tilted(tilt)));
    // about the keel: arm of the volume and second moment of the waterplane
    const double length = 10.0 / std::cos(tilt);
    const double along = 0.5 * length + std::pow(2.0 * std::tan(tilt), 2) / (8.0 * length);
    const double beside = 4.0 * std::tan(tilt) / (4.0 * length);
    const double x = along * std::sin(tilt) + beside * std::cos(tilt);
    // what counts as upright lacks the square of the tilt
    EXPECT_NEAR(-found.moment[1] / (weight * 4.0 * pi * length), x,
                (1e-9 + 0.2 * tilt * tilt) * tilt);
  }
}

TEST(Buoyancy, OfALyingCylinderIsTheSegmentOfItsSection) {
  MovedMember log(member({-5, 0, 0}, {5, 0, 0}, pipe(2.0), pipe(2.0), 4), still_water());
  for (const double depth : {-1.5, -0.7, 0.0, 0.4, 0.99, 3.0}) {
    const auto found = log.stand(MovedMember::placed({0.0, 0.0, -depth}, Mat3::Identity()));
    const double d = std::clamp(depth, -1.0, 1.0);
    const double area = std::acos(-d) + d * std::sqrt(1.0 - d * d);
    EXPECT_NEAR(found.force[2], weight * area * 10.0, 1e-8 * weight);
    EXPECT_NEAR(found.moment.norm(), 0.0, 1e-8 * weight);
  }
}

// Pressure on the surface of a cone, integrated over its mantle and the faces that are wet.
flow::FluidForce::Resultant pressed(const Vec3& from, const Vec3& to, double r0, double r1,
                                    const std::array<bool, 2>& wet) {
  flow::FluidForce::Resultant sum;
  const Vec3 t = (to - from).normalized();
  const Vec3 e1 = t.unitOrthogonal(), e2 = t.cross(e1);
  const double length = (to - from).norm();
  const auto press = [&](const Vec3& place, const Vec3& area) {
    const Vec3 force = weight * std::min(place[2], 0.0) * area;
    sum.force += force;
    sum.moment += place.cross(force);
  };
  const int n = 1200;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * pi * (i + 0.5) / n;
    const Vec3 radial = std::cos(angle) * e1 + std::sin(angle) * e2;
    for (int k = 0; k < n; ++k) {
      const double s = (k + 0.5) / n, r = r0 + s * (r1 - r0);
      const Vec3 place = from + s * (to - from) + r * radial;
      press(place, (radial * length - (r1 - r0) * t) * (r * 2.0 * pi / n / n));
    }
    for (std::size_t end = 0; end < 2; ++end) {
      if (!wet[end]) continue;
      const double radius = end == 0 ? r0 : r1;
      for (int k = 0; k < n / 4; ++k) {
        const double r = radius * (k + 0.5) * 4.0 / n;
        press((end == 0 ? from : to) + r * radial,
              (end == 0 ? -1.0 : 1.0) * t * (r * radius * 2.0 * pi / n * 4.0 / n));
      }
    }
  }
  return sum;
}

// By volume less what is not wet, or by pressure on what is: the same, wherever the surface is.
TEST(Buoyancy, IsThePressureOnTheWetSurface) {
  const Vec3 axis = Vec3(0.7, 0.3, 1.0).normalized();
  for (const std::array<bool, 2> wet : {std::array{true, true}, {false, true}, {false, false}}) {
    for (const double low : {-9.0, -3.0, -0.5}) {
      const Vec3 from(0.4, -0.2, low), to = from + 6.0 * axis;
      std::vector<Segment> one = {segment(from, to, 3.0, 2.0)};
      for (std::size_t end = 0; end < 2; ++end)
        one[0].faces[end] = wet[end] ? Face::wet : Face::dry;
      MovedMember cone(one, still_water());
      const auto found = cone.stand(MovedMember::placed(Vec3::Zero(), Mat3::Identity()));
      const auto expected = pressed(from, to, 1.5, 1.0, wet);
      const double scale = weight * 9.0;
      EXPECT_NEAR((found.force - expected.force).norm() / scale, 0.0, 2e-5) << low << wet[0];
      EXPECT_NEAR((found.moment - expected.moment).norm() / scale, 0.0, 2e-5) << low << wet[0];
    }
  }
}

TEST(Buoyancy, OfAFloodedMemberIsThatOfItsWall) {
  std::vector<Segment> outer = member(Vec3::Zero(), {0, 0, 20}, pipe(4.0), pipe(4.0), 3);
  std::vector<Segment> inner = member(Vec3::Zero(), {0, 0, 20}, pipe(3.0), pipe(3.0), 3);
  std::vector<Segment> tube = outer;
  for (std::vector<Segment>* all : {&outer, &inner, &tube}) all->front().faces[0] = Face::dry;
  for (Segment& one : tube) {
    for (WetSection& section : one.sections) section.flooded_diameter = 3.0;
  }
  for (const double tilt : {0.0, 0.4}) {
    const auto q = MovedMember::placed({1.0, 0.0, -10.0}, tilted(tilt));
    const auto of = [&](const std::vector<Segment>& all) {
      return MovedMember(all, still_water()).stand(q);
    };
    const auto whole = of(outer), hole = of(inner), wall = of(tube);
    EXPECT_NEAR((wall.force - whole.force + hole.force).norm(), 0.0, 1e-8 * weight);
    EXPECT_NEAR((wall.moment - whole.moment + hole.moment).norm(), 0.0, 1e-7 * weight);
  }
}

// Also where the surface stands at the end of a segment.
TEST(Buoyancy, HasTheStiffnessOfItsWaterplane) {
  for (const double tilt : {0.0, 0.3}) {
    MovedMember pile(member(Vec3::Zero(), {0, 0, 20}, pipe(4.0), pipe(4.0), 4), still_water());
    for (const double axis :
         {-5.0, -10.0, -10.0 - 1e-14, -10.0 + 1e-14, -10.3}) {  // m of it in the water
      const auto q = MovedMember::placed({0.0, 0.0, axis * std::cos(tilt)}, tilted(tilt));
      const Mat3 K = pile.stiffness(q);
      EXPECT_NEAR(K(2, 2), weight * 4.0 * pi / std::cos(tilt), 1e-8 * weight) << tilt << axis;
      EXPECT_NEAR(K.norm(), K(2, 2), 1e-9 * weight);
    }
  }
}

TEST(Buoyancy, OffMeansOff) {
  MovedMember pile(member(Vec3::Zero(), {0, 0, 20}, pipe(4.0), pipe(4.0), 3), still_water(),
                   {.buoyancy = false});
  const auto found = pile.stand(MovedMember::placed({0.0, 0.0, -10.0}, tilted(0.3)));
  EXPECT_EQ(found.force.norm(), 0.0);
  EXPECT_EQ(found.moment.norm(), 0.0);
}

}  // namespace
}  // namespace culm::water
