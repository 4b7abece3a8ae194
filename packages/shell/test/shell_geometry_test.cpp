#include "shell_case.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace culm::shell {
namespace {

Nodes flat_reference() {
  Nodes q;
  q << 0.0, 0.0, 2.0, 0.0, 2.0, 0.0, 0.0, 0.0,  //
      0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0,   //
      0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0;
  return q;
}

TEST(ShellGeometry, AxesFollowTheReferenceAxisAndTheAngle) {
  const double angle = 0.3;
  const ShellGeometry by_line(flat_reference(), 0.1, {});
  EXPECT_LT((by_line.axes(0.2, -0.4, 0.03) - Mat3::Identity()).norm(), 1e-15);
  const ShellGeometry given(flat_reference(), 0.1, {.reference_axis = Vec3(0.0, 2.0, 5.0)});
  Mat3 expected;
  expected << Vec3::UnitY(), -Vec3::UnitX(), Vec3::UnitZ();
  EXPECT_LT((given.axes(0.0, 0.0, 0.0) - expected).norm(), 1e-15);
  const Mat3 turned = by_line.axes(0.0, 0.0, 0.0, angle);
  EXPECT_LT((turned.col(0) - Vec3(std::cos(angle), std::sin(angle), 0.0)).norm(), 1e-15);
  EXPECT_LT((turned.col(0).cross(turned.col(1)) - Vec3::UnitZ()).norm(), 1e-15);
}

// a homogeneous deformation has the same strains everywhere, assumed or not
TEST(ShellGeometry, HomogeneousStrainIsSeenAtEveryPoint) {
  const Mat3 F = Mat3::Identity() + 0.3 * kit::Random(3).matrix<3, 3>();
  const Mat3 green = 0.5 * (F.transpose() * F - Mat3::Identity());
  // directors of length one, so that the bilinear map is F itself
  const Nodes q = F * warped_reference();
  const ShellForms forms(warped_reference());
  ShellForms::Strain y;
  forms.strain(0, q, y);
  // On warped elements only the plain strains are exact: assumed ones are sampled elsewhere.
  const ShellGeometry geometry(warped_reference(), 0.1,
                               {.assumed_shear = false, .assumed_thickness = false});
  const Mat3 A = geometry.axes(0.3, -0.6, 0.02, 0.4);
  const Mat3 local = A.transpose() * green * A;
  const Vec6 expected = (Vec6() << local(0, 0), local(1, 1), local(2, 2), 2.0 * local(1, 2),
                         2.0 * local(0, 2), 2.0 * local(0, 1))
                            .finished();
  EXPECT_LT((geometry.at(0.3, -0.6, 0.02, 0.4).strain * y - expected).norm(), 1e-14);
}

TEST(ShellGeometry, SoundElementsHaveNoMistakes) {
  EXPECT_TRUE(shell_mistakes(flat_reference(), 0.1).empty());
  EXPECT_TRUE(shell_mistakes(warped_reference(), 0.2).empty());
}

TEST(ShellGeometry, ClockwiseNodesAreFound) {
  Nodes q = flat_reference();
  q.middleCols<2>(2).swap(q.middleCols<2>(6));
  ASSERT_EQ(shell_mistakes(q, 0.1).size(), 1u);
  EXPECT_NE(shell_mistakes(q, 0.1)[0].find("corner 1 is not positive:"), std::string::npos);
}

TEST(ShellGeometry, TooMuchThicknessForTheCurvatureIsFound) {
  const Nodes q = warped_reference();  // directors meet about 2.5 below
  EXPECT_TRUE(shell_mistakes(q, 1.0).empty());
  ASSERT_EQ(shell_mistakes(q, 5.0).size(), 1u);
  EXPECT_NE(shell_mistakes(q, 5.0)[0].find("at a face"), std::string::npos);
}

TEST(ShellGeometry, ReferenceAxisAlongTheNormalIsFound) {
  EXPECT_EQ(shell_mistakes(flat_reference(), 0.1, {.reference_axis = Vec3(0.0, 0.0, 3.0)}),
            std::vector<std::string>{"the reference axis points along its normal"});
}

}  // namespace
}  // namespace culm::shell
