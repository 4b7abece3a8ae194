#include <culm/coupling/channel_flow.hpp>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace culm::coupling {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using std::numbers::pi;

const FlowChannel water = {1000.0, 0.2, 0.1, Vector3d(0.0, 0.0, 1.0)};
constexpr int row_points = 9;
constexpr double distance = 0.1;  // channel of 1 m

VectorXd row() {
  VectorXd x = VectorXd::Zero(3 * row_points);
  for (int i = 0; i < row_points; ++i) x[3 * i] = (i + 1) * distance;
  return x;
}

// The masses of the sines are those of the source, for a strip of 0.1 m by 0.1 m at each point.
TEST(ChannelFlow, HasTheMassesOfTheSource) {
  const MatrixXd masses = channel_masses(water, row_points, distance);
  EXPECT_TRUE(masses.isApprox(masses.transpose(), 1e-14));
  for (int i = 1; i <= row_points; ++i) {
    VectorXd sine(row_points);
    for (int k = 0; k < row_points; ++k) sine[k] = std::sin(pi * i * (k + 1) * distance);
    const double mass = 1000.0 * 0.1 * distance / (i * pi * std::tanh(i * pi * 0.2));
    EXPECT_LT((masses * sine - mass * sine).norm(), 1e-13 * mass * sine.norm()) << i;
  }
}

// A shallow channel resists a sine as flow along it does: mu = L^2 / (i pi)^2 H.
TEST(ChannelFlow, IsThatOfShallowWater) {
  FlowChannel shallow = water;
  shallow.height = 1e-3;
  const double largest = channel_masses(shallow, row_points, distance)
                             .selfadjointView<Eigen::Lower>()
                             .eigenvalues()
                             .maxCoeff();
  EXPECT_NEAR(largest * pi * pi * 1e-3 / (1000.0 * 0.1 * distance), 1.0, 1e-5);
}

// What it takes along the normal it gives back, and nothing else moves it.
TEST(ChannelFlow, KeepsItsBooks) {
  const auto flow = make_channel_flow(water);
  ASSERT_EQ(flow->objection(row()), "");
  flow->begin(row(), VectorXd::Constant(3 * row_points, 0.3));
  double work = 0.0, size = 0.0;
  for (int i = 0; i < 50; ++i) {
    VectorXd moved(3 * row_points);
    for (int k = 0; k < moved.size(); ++k) moved[k] = 1e-3 * std::sin(0.7 * i + 1.3 * k);
    const VectorXd forces = flow->forces(moved, 0.01);
    for (int k = 0; k < row_points; ++k)
      EXPECT_EQ(forces.segment<2>(3 * k), Eigen::Vector2d::Zero());
    const VectorXd memory = flow->memory();
    flow->accept(2.0 * moved, 0.01);
    flow->restore(memory);
    flow->accept(moved, 0.01);
    work += forces.dot(moved);
    size += std::abs(forces.dot(moved));
  }
  EXPECT_NEAR(work + flow->books().energy, 0.0, 1e-12 * size);
}

TEST(ChannelFlow, NeedsARow) {
  const auto flow = make_channel_flow(water);
  VectorXd bent = row();
  bent[3 * 4 + 2] = 0.01;
  EXPECT_EQ(flow->objection(bent),
            "needs points at equal distances on a straight line; point 4 is 0.01 m away from its "
            "place");
  EXPECT_EQ(flow->objection(VectorXd::Zero(3)), "needs two points at least");
  FlowChannel askew = water;
  askew.normal = Vector3d(1.0, 0.0, 0.0);
  EXPECT_EQ(make_channel_flow(askew)->objection(row()),
            "needs a 'Normal' at right angles to the line of its points");
}

}  // namespace
}  // namespace culm::coupling
