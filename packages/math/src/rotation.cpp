#include <culm/math/rotation.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <cmath>

namespace culm {

Mat3 exp_rotation(const Vec3& theta) {
  const double t2 = theta.squaredNorm();
  const Mat3 W = skew(theta);
  double a = 0.0;  // sin t / t
  double b = 0.0;  // (1 - cos t) / t^2
  if (t2 < 1e-4) {
    a = 1.0 - t2 / 6.0 * (1.0 - t2 / 20.0 * (1.0 - t2 / 42.0));
    b = 0.5 - t2 / 24.0 * (1.0 - t2 / 30.0 * (1.0 - t2 / 56.0));
  } else {
    const double t = std::sqrt(t2);
    const double half_sine = std::sin(0.5 * t);
    a = std::sin(t) / t;
    b = 2.0 * half_sine * half_sine / t2;
  }
  return Mat3::Identity() + a * W + b * W * W;
}

Vec3 log_rotation(const Mat3& R) {
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
  int least = 0;
  unit.cwiseAbs().minCoeff(&least);
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
