#include <culm/shell/hourglass.hpp>

#include <Eigen/Dense>

#include <algorithm>

namespace culm::shell {

namespace {

// Compression beyond it is left to the material alone: twice the ten per cent that elements are
// meant for.
constexpr double largest_strain = 0.2;

double smaller_eigenvalue(const Mat<2, 2>& symmetric) {
  Eigen::SelfAdjointEigenSolver<Mat<2, 2>> solver;
  return solver.computeDirect(symmetric, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

// Young's modulus along a unit vector, by the compliance in the plane.
double modulus_along(const Vec<2>& e, const Mat3& compliance) {
  const Vec3 stress(e[0] * e[0], e[1] * e[1], e[0] * e[1]);
  return 1.0 / stress.dot(compliance * stress);
}

// Smallest stiffness against waves with the normal m: the compression along m that takes all of it.
double shear_limit(const Vec<2>& m, const Mat3& stiffness) {
  Mat<3, 2> N;
  N << m[0], 0.0, 0.0, m[1], m[1], m[0];
  return smaller_eigenvalue(N.transpose() * stiffness * N);
}

}  // namespace

Vec<2> hourglass_factors(const Mat<2, 2>& half_sides, const material::Layup& layup) {
  if (!layup.is_linear()) return Vec<2>::Zero();
  const double thickness = layup.thickness();
  const Mat6 wall = material::laminate_stiffness(layup);
  const Mat3 stiffness = wall.topLeftCorner<3, 3>() / thickness;
  // unsymmetric walls may bend as they are stretched
  const Mat3 compliance = thickness * wall.inverse().topLeftCorner<3, 3>();
  Mat<2, 2> bending = Mat<2, 2>::Zero();
  for (int i = 0; i < 2; ++i) {
    const Vec<2> e = half_sides.col(i).normalized();
    bending += modulus_along(e, compliance) / half_sides.col(i).squaredNorm() * e * e.transpose();
  }
  const double least = smaller_eigenvalue(bending);
  const Mat<2, 2> normals = half_sides.inverse();  // rows
  Vec<2> factors;
  for (int i = 0; i < 2; ++i) {
    const Vec<2> normal = normals.row(i).transpose();
    const Vec<2> m = normal.normalized();
    const double limit =
        std::min(shear_limit(m, stiffness), largest_strain * modulus_along(m, compliance));
    factors[i] = std::min(1.0, least / (2.0 * normal.squaredNorm() * limit));
  }
  return factors;
}

}  // namespace culm::shell
