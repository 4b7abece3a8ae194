#include <culm/math/rotation.hpp>
#include <culm/mechanics/triad_pack.hpp>

#include <gtest/gtest.h>

namespace culm {
namespace {

// Motions of different size: from none to more than a quarter of a turn, beyond all series.
Vec6 motion_of(int lane) {
  const double size = lane == 0 ? 0.0 : 1e-4 * std::pow(4.0, lane);
  return size * Vec6{1.0, -0.5, 0.2, 0.6, -0.3, 0.74};
}

Mat3 triad_of(int lane) { return exp_rotation(Vec3(0.3 * lane, -1.0, 0.1 * lane * lane)); }

class TriadPack : public testing::Test {
 protected:
  TriadPack() {
    for (int l = 0; l < pack_lanes; ++l) {
      const Mat3 D = triad_of(l);
      for (int c = 0; c < 3; ++c) start.of(l, c) = 0.1 * l + c;
      for (int c = 0; c < 9; ++c) start.of(l, 3 + c) = D.data()[c];
      for (int c = 0; c < 6; ++c) u.of(l, c) = motion_of(l)[c];
    }
  }

  Packs<12> start;
  Packs<6> u;
};

TEST_F(TriadPack, MovesEachAsOneIsMoved) {
  Packs<12> moved = start;
  move_triads(u, moved);
  for (int l = 0; l < pack_lanes; ++l) {
    const Vec6 motion = motion_of(l);
    const Mat3 D = polar_correction(exp_rotation(motion.tail<3>()) * triad_of(l));
    for (int c = 0; c < 3; ++c) EXPECT_EQ(moved.of(l, c), start.of(l, c) + motion[c]);
    for (int c = 0; c < 9; ++c) EXPECT_NEAR(moved.of(l, 3 + c), D.data()[c], 4e-16) << "lane " << l;
  }
}

TEST_F(TriadPack, TakesRoundingOutOfTriads) {
  Packs<12> moved = start;
  for (int c = 3; c < 12; ++c) moved[static_cast<std::size_t>(c)] *= 1.0 + 1e-9 * c;
  move_triads(Packs<6>{}, moved);
  for (int l = 0; l < pack_lanes; ++l) {
    Mat3 D;
    for (int c = 0; c < 9; ++c) D.data()[c] = moved.of(l, 3 + c);
    EXPECT_LT(triad_defect(D), 1e-15);
  }
}

TEST_F(TriadPack, FindsTheMotionBetween) {
  Packs<12> moved = start;
  move_triads(u, moved);
  Packs<6> found;
  find_motions(start, moved, found);
  for (int l = 0; l < pack_lanes; ++l) {
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(found.of(l, c), motion_of(l)[c], 1e-15) << "lane " << l;
  }
}

TEST_F(TriadPack, FindsRatesOfRigidMotions) {
  Packs<12> velocities;
  for (int l = 0; l < pack_lanes; ++l) {
    const Vec6 motion = motion_of(l);
    for (int c = 0; c < 3; ++c) velocities.of(l, c) = motion[c];
    for (int i = 1; i < 4; ++i) {
      const Vec3 w = motion.tail<3>().cross(Vec3(triad_of(l).col(i - 1)));
      for (int c = 0; c < 3; ++c) velocities.of(l, 3 * i + c) = w[c];
    }
  }
  Packs<6> rates;
  find_rates(start, velocities, rates);
  for (int l = 0; l < pack_lanes; ++l) {
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(rates.of(l, c), motion_of(l)[c], 2e-15) << "lane " << l;
  }
}

}  // namespace
}  // namespace culm
