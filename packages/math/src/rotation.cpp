#include <culm/math/rotation.hpp>
#include <culm/math/rotation_series.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <cmath>

namespace culm {
RotationFactors rotation_factors(double t2) {
  if (t2 < small_turn_squared) {
    RotationFactors factors{};
    find_polynomial(sine_series, t2, factors.sine);
    find_polynomial(cosine_series, t2, factors.cosine);
    return factors;
  }
  const double t = std::sqrt(t2);
  const double half_sine = std::sin(0.5 * t);
  return {std::sin(t) / t, 2.0 * half_sine * half_sine / t2};
}

Mat3 exp_rotation(const Vec3& theta) {
  const double x = theta[0], y = theta[1], z = theta[2];
  const double t2 = x * x + y * y + z * z;
  const auto [a, b] = rotation_factors(t2);
  // 1 + a [theta] + b [theta]^2, with [theta]^2 = theta theta^T - t^2 1
  const double c = 1.0 - b * t2;
  const double xy = b * x * y, yz = b * y * z, zx = b * z * x;
  Mat3 R;
  R << c + b * x * x, xy - a * z, zx + a * y,  //
      xy + a * z, c + b * y * y, yz - a * x,   //
      zx - a * y, yz + a * x, c + b * z * z;
  return R;
}

Mat3 polar_correction(const Mat3& D) {
  return 0.5 * D * (3.0 * Mat3::Identity() - D.transpose() * D);
}

Vec3 log_rotation(const Mat3& R) {
  const Vec3 twice(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  const double s2 = 0.25 * twice.squaredNorm();  // sin^2 t
  if (s2 < small_turn_squared && R.trace() > 1.0) {
    double factor = 0.0;
    find_polynomial(arcsine_series, s2, factor);
    return 0.5 * factor * twice;
  }
  const Eigen::AngleAxisd rotation(R);
  return rotation.angle() * rotation.axis();
}

Mat3 nearest_rotation(const Mat3& D) {
  const Eigen::JacobiSVD<Mat3> svd(D, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0.0) U.col(2) = -U.col(2);
  return U * svd.matrixV().transpose();
}

double triad_defect(const Mat3& D) {
  if (D.determinant() < 0.0) return 2.0;
  return (D.transpose() * D - Mat3::Identity()).cwiseAbs().maxCoeff();
}

Mat3 triad_along(const Vec3& axis, const Vec3& up) {
  Mat3 D;
  const Vec3 d3 = axis.normalized();
  const Vec3 d1 = (up - up.dot(d3) * d3).normalized();
  D << d1, d3.cross(d1), d3;
  return D;
}

Vec3 any_normal(const Vec3& n) {
  const Vec3 unit = n.normalized();
  // of axes that are alike the first, whatever rounding made of their components
  constexpr double alike = 1e-4;
  const Vec3 along = unit.cwiseAbs();
  int least = 0;
  while (along[least] > along.minCoeff() + alike) ++least;
  const Vec3 e = Vec3::Unit(least);
  return (e - e.dot(unit) * unit).normalized();
}

Vec3 cayley_vector(const Mat3& prev, const Mat3& next) {
  const Mat3 mid = 0.5 * (prev + next);
  const Mat3 Ac = mid.squaredNorm() * Mat3::Identity() - mid * mid.transpose();
  Vec3 moment = Vec3::Zero();
  for (int i = 0; i < 3; ++i) moment += mid.col(i).cross(next.col(i) - prev.col(i));
  return Ac.inverse() * moment;
}

}  // namespace culm
