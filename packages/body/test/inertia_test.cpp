#include <culm/body/inertia.hpp>
#include <culm/math/quadrature.hpp>
#include <culm/model/inertia.hpp>

#include <culm_kit/rigid_motion.hpp>
#include <gmock/gmock.h>

#include <numbers>

namespace culm::body {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Inertia, EulerTensorAndInertiaTensorBelongTogether) {
  Mat3 J;
  J << 3.0, 0.2, -0.1, 0.2, 2.0, 0.3, -0.1, 0.3, 1.0;
  const Mat3 tensor = J.trace() * Mat3::Identity() - J;
  EXPECT_LT((euler_tensor(tensor) - J).norm(), 1e-15);
}

// T = 1/2 m v_c^2 + 1/2 omega . Theta omega for any rigid motion
TEST(Inertia, KineticEnergyIsThatOfTheRigidBody) {
  kit::Random random(4);
  const Mat3 D = random.rotation();
  const Vec3 v = random.vector();
  const Vec3 omega = random.vector();
  const Inertia body{2.5, Vec3(0.3, -0.2, 0.5), Vec3(1.0, 1.5, 0.9).asDiagonal()};
  Slots<4> q;
  q << random.vector(), D;
  Slots<4> velocity;
  velocity << v, skew(omega) * D;
  model::Momentum momentum;
  model::add_item_momentum<4>(mass_matrix(body), q, velocity, momentum);

  const Vec3 lever = D * body.centre;
  const Vec3 v_centre = v + skew(omega) * lever;
  const Vec3 spin = D * body.tensor * D.transpose() * omega;
  EXPECT_NEAR(momentum.kinetic_energy,
              0.5 * body.mass * v_centre.squaredNorm() + 0.5 * omega.dot(spin), 1e-13);
  EXPECT_LT((momentum.linear - body.mass * v_centre).norm(), 1e-13);
  const Vec3 centre = q.col(0) + lever;
  EXPECT_LT((momentum.angular - (skew(centre) * (body.mass * v_centre) + spin)).norm(), 1e-13);
}

TEST(Inertia, ShapesAgreeWithTextbooks) {
  const Inertia box = solid_box({1.0, 2.0, 3.0}, 0.5);
  EXPECT_NEAR(box.mass, 3.0, 1e-15);
  EXPECT_NEAR(box.tensor(0, 0), 3.0 * (4.0 + 9.0) / 12.0, 1e-14);
  const Inertia cylinder = solid_cylinder(2.0, 3.0, 1.0);
  EXPECT_NEAR(cylinder.tensor(2, 2), 0.5 * cylinder.mass * 4.0, 1e-12);
  EXPECT_NEAR(cylinder.tensor(0, 0), cylinder.mass * (3.0 * 4.0 + 9.0) / 12.0, 1e-12);
  const Inertia sphere = solid_sphere(2.0, 1.0);
  EXPECT_NEAR(sphere.tensor(1, 1), 0.4 * sphere.mass * 4.0, 1e-12);
  const Inertia cone = solid_cone(2.0, 4.0, 3.0);
  EXPECT_NEAR(cone.mass, std::numbers::pi * 16.0, 1e-12);
  EXPECT_NEAR(cone.tensor(2, 2), 0.3 * cone.mass * 4.0, 1e-12);
  EXPECT_NEAR(cone.tensor(0, 0), 3.0 / 80.0 * cone.mass * (4.0 * 4.0 + 16.0), 1e-12);
}

TEST(Inertia, ImpossibleBodiesAreRefused) {
  Inertia body{1.0, Vec3::Zero(), Vec3(1.0, 1.0, 2.5).asDiagonal()};
  EXPECT_THAT(mistakes(body), ElementsAre(HasSubstr("larger than the sum")));
  body.tensor = Vec3(1.0, 1.0, 0.0).asDiagonal();
  EXPECT_THAT(mistakes(body), ElementsAre(HasSubstr("on a line")));
  body.tensor = Vec3(1.0, 1.0, 2.0).asDiagonal();
  EXPECT_THAT(mistakes(body), ElementsAre());  // a thin plate
}

}  // namespace
}  // namespace culm::body
