#include <culm/lattice/biot_savart.hpp>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace culm::lattice {
namespace {

Vec3 one(const Segments& segments, std::vector<double> strengths, const Vec3& at) {
  Points points, velocities(1);
  points.push_back(at);
  add_velocities(segments, strengths, points, velocities);
  return velocities.at(0);
}

TEST(BiotSavart, LongStraightVortexTurnsTheFlowAroundIt) {
  Segments segments;
  segments.push_back({0.0, -1e6, 0.0}, {0.0, 1e6, 0.0}, 0.0);
  const Vec3 v = one(segments, {3.0}, {2.0, 0.3, 0.0});
  EXPECT_NEAR(v.z(), -3.0 / (2.0 * std::numbers::pi * 2.0), 1e-12);
  EXPECT_NEAR(v.x(), 0.0, 1e-15);
  EXPECT_NEAR(v.y(), 0.0, 1e-15);
}

// The core of Vatistas with n = 2: at h = r_c the velocity is 1 / sqrt(2) of that without core.
TEST(BiotSavart, CoreOfALongVortex) {
  Segments segments;
  segments.push_back({0.0, -1e3, 0.0}, {0.0, 1e3, 0.0}, 0.4);
  for (const double h : {0.1, 0.4, 2.0}) {
    EXPECT_NEAR(-one(segments, {1.0}, {h, 0.0, 0.0}).z() * 2.0 * std::numbers::pi * h,
                h * h / std::sqrt(h * h * h * h + 0.4 * 0.4 * 0.4 * 0.4), 1e-5);
  }
}

TEST(BiotSavart, FiniteSegmentByTheAnglesOfItsEnds) {
  // v = G / (4 pi h) (cos b1 + cos b2)
  Segments segments;
  segments.push_back({-1.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, 0.0);
  const double h = 0.7;
  const double expected =
      1.0 / (4.0 * std::numbers::pi * h) * (1.0 / std::hypot(1.0, h) + 3.0 / std::hypot(3.0, h));
  EXPECT_NEAR(one(segments, {1.0}, {0.0, h, 0.0}).z(), expected, 1e-14);
}

TEST(BiotSavart, FiniteOnTheSegmentAndOnItsContinuation) {
  Segments segments;
  segments.push_back({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, 1e-3);
  segments.push_back({1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}, 1e-3);
  for (const double s : {0.0, 0.3, 1.0, 2.0}) {
    const Vec3 v = one(segments, {1.0, 1.0}, {s, s, s});
    EXPECT_NEAR(v.norm(), 0.0, 1e-9) << s;
  }
}

// Whatever the number of points, and so whichever lanes of vectors they stand in.
TEST(BiotSavart, SumsOverSegmentsForManyPoints) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto somewhere = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  Segments segments;
  std::vector<double> strengths;
  for (int s = 0; s < 37; ++s) {
    segments.push_back(somewhere(), somewhere(), 0.05);
    strengths.push_back(uniform(random));
  }
  Points points, normals;
  for (int i = 0; i < 777; ++i) {
    points.push_back(somewhere());
    normals.push_back(somewhere());
  }
  Points velocities(points.size());
  add_velocities(segments, strengths, points, velocities);
  std::vector<double> along(points.size(), 0.0);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    add_normal_velocities(segments, s, strengths[s], points, normals, along);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vec3 expected = Vec3::Zero();
    for (std::size_t s = 0; s < segments.size(); ++s) {
      const Vec3 a = points.at(i) - segments.from.at(s), b = points.at(i) - segments.to.at(s);
      const double cut = 0.5 * 0.05 * 0.05 * (a - b).squaredNorm();
      const double product = a.norm() * b.norm();
      expected += strengths[s] / (4.0 * std::numbers::pi) * (a.norm() + b.norm()) /
                  std::hypot(product * (product + a.dot(b)), cut) * a.cross(b);
    }
    EXPECT_NEAR((velocities.at(i) - expected).norm(), 0.0, 1e-12);
    EXPECT_NEAR(along[i], expected.dot(normals.at(i)), 1e-12);
  }
}

}  // namespace
}  // namespace culm::lattice
