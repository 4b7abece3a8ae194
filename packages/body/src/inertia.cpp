#include <culm/body/inertia.hpp>

#include <Eigen/Eigenvalues>

#include <numbers>

namespace culm::body {

Mat3 euler_tensor(const Mat3& inertia_tensor) {
  return 0.5 * inertia_tensor.trace() * Mat3::Identity() - inertia_tensor;
}

SlotMatrix<4> mass_matrix(const Inertia& inertia) {
  const Vec3 S = inertia.mass * inertia.centre;
  SlotMatrix<4> M;
  M(0, 0) = inertia.mass;
  M.bottomLeftCorner<3, 1>() = S;
  M.topRightCorner<1, 3>() = S.transpose();
  M.bottomRightCorner<3, 3>() = euler_tensor(inertia.tensor) + S * inertia.centre.transpose();
  return M;
}

std::vector<std::string> mistakes(const Inertia& inertia) {
  std::vector<std::string> found;
  const Mat3& T = inertia.tensor;
  if (!T.isApprox(T.transpose(), 1e-12)) found.emplace_back("the inertia tensor is not symmetric");
  const Vec3 moments =
      Eigen::SelfAdjointEigenSolver<Mat3>(euler_tensor(T), Eigen::EigenvaluesOnly).eigenvalues();
  const double round_off = 1e-10 * T.trace();
  if (moments[0] < -round_off) {
    found.emplace_back(
        "no body has this inertia tensor: one principal moment is larger than the sum of the "
        "others");
  } else if (moments[1] <= round_off) {
    found.emplace_back("all mass lies on a line, so nothing resists the rotation about it");
  }
  return found;
}

namespace {

// Diagonal inertia tensor from the mean squares of the coordinates about the centre of mass.
Inertia from_mean_squares(double mass, const Vec3& squares) {
  const Vec3 second = mass * squares;
  return {mass, Vec3::Zero(), (second.sum() * Vec3::Ones() - second).asDiagonal()};
}

}  // namespace

Inertia solid_box(const Vec3& size, double density) {
  return from_mean_squares(density * size.prod(), size.cwiseAbs2() / 12.0);
}

Inertia solid_cylinder(double radius, double height, double density) {
  const double r2 = radius * radius / 4.0;
  return from_mean_squares(density * std::numbers::pi * radius * radius * height,
                           {r2, r2, height * height / 12.0});
}

Inertia solid_sphere(double radius, double density) {
  return from_mean_squares(4.0 / 3.0 * std::numbers::pi * radius * radius * radius * density,
                           Vec3::Constant(radius * radius / 5.0));
}

Inertia solid_cone(double radius, double height, double density) {
  const double r2 = 3.0 / 20.0 * radius * radius;
  Inertia cone = from_mean_squares(density * std::numbers::pi * radius * radius * height / 3.0,
                                   {r2, r2, 3.0 / 80.0 * height * height});
  cone.centre = Vec3(0.0, 0.0, 0.25 * height);
  return cone;
}

}  // namespace culm::body
