#include <culm/port/faces.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace culm::port {
namespace {

// A box of 1 x 2 x 3 m with quadrilaterals and triangles, and the same deformed at random.
class Box : public testing::Test {
 protected:
  std::vector<double> straight = {0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 2, 0,
                                  0, 0, 3, 1, 0, 3, 1, 2, 3, 0, 2, 3};
  std::vector<Face> faces = {{0, 3, 2, 1},  {4, 5, 6, 7},  {0, 1, 5, 4}, {1, 2, 6, 5},
                             {2, 3, 7, -1}, {2, 7, 6, -1}, {3, 0, 4, 7}};

  std::vector<double> bent(double size) const {
    std::vector<double> x = straight;
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += size * std::sin(1.0 + 3.7 * static_cast<double>(i * i));
    }
    return x;
  }
  static Vec3 sum(const std::vector<double>& forces) {
    return Eigen::Map<const Eigen::Matrix3Xd>(forces.data(), 3,
                                              static_cast<Eigen::Index>(forces.size() / 3))
        .rowwise()
        .sum();
  }
  static Vec3 moment(const std::vector<double>& forces, const std::vector<double>& x) {
    Vec3 total = Vec3::Zero();
    for (std::size_t i = 0; i < x.size(); i += 3) {
      total += Vec3(x[i], x[i + 1], x[i + 2]).cross(Vec3(forces[i], forces[i + 1], forces[i + 2]));
    }
    return total;
  }
};

TEST_F(Box, HasItsVolume) {
  EXPECT_TRUE(is_closed(faces));
  EXPECT_NEAR(volume(faces, straight), 6.0, 1e-14);
  std::vector<Face> open = faces;
  open.pop_back();
  EXPECT_FALSE(is_closed(open));
}

// Patch test: constant pressure on whatever closed surface has no resultant and no moment.
TEST_F(Box, ConstantPressureIsInEquilibrium) {
  const std::vector<double> x = bent(0.3);
  const auto forces = face_forces(faces, x, x, std::vector(faces.size(), 5.0), {});
  EXPECT_LT(sum(forces).norm(), 1e-13);
  EXPECT_LT(moment(forces, x).norm(), 1e-13);
  EXPECT_GT(Vec3(forces[0], forces[1], forces[2]).norm(), 1.0);
}

// With one face open, pressure times area is left.
TEST_F(Box, AnOpenFaceLeavesPressureTimesArea) {
  std::vector<Face> open(faces.begin() + 1, faces.end());  // without the bottom
  const auto forces = face_forces(open, straight, straight, std::vector(open.size(), 5.0), {});
  EXPECT_LT((sum(forces) - Vec3(0.0, 0.0, -5.0 * 2.0)).norm(), 1e-13);
}

// The work over any straight motion is pressure times the change of volume.
TEST_F(Box, WorkIsThatOfTheVolume) {
  const std::vector<double> from = bent(0.2), to = bent(-0.4);
  const auto forces = face_forces(faces, from, to, std::vector(faces.size(), 5.0), {});
  double work = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) work += forces[i] * (to[i] - from[i]);
  EXPECT_GT(std::abs(work), 0.1);
  EXPECT_NEAR(work, -5.0 * (volume(faces, to) - volume(faces, from)), 1e-12);
}

TEST_F(Box, TractionIsForcePerArea) {
  std::vector<double> traction(3 * faces.size(), 0.0);
  traction[3] = 7.0;  // along x, on the top
  const auto forces = face_forces(faces, straight, straight, {}, traction);
  EXPECT_LT((sum(forces) - Vec3(14.0, 0.0, 0.0)).norm(), 1e-13);
  EXPECT_NEAR(moment(forces, straight)[1], 14.0 * 3.0, 1e-12);
}

TEST_F(Box, FacesAreChecked) {
  EXPECT_EQ(objection_to(faces, 8), "");
  EXPECT_EQ(objection_to(faces, 7), "face 1 names point 7; there are 7, from 0");
  faces[2] = {0, 1, 1, 4};
  EXPECT_EQ(objection_to(faces, 8), "face 2 names a point twice");
  faces[2] = {0, 1, 2, -7};
  EXPECT_EQ(objection_to(faces, 8), "face 2 names point -7; there are 8, from 0");
}

}  // namespace
}  // namespace culm::port
