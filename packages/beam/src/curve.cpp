#include <culm/beam/curve.hpp>
#include <culm/math/rotation.hpp>
#include <culm/math/spline.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace culm::beam {

Curve line(const Vec3& from, const Vec3& to) {
  const Vec3 direction = (to - from).normalized();
  return {.length = (to - from).norm(),
          .position = [=](double s) -> Vec3 { return from + s * direction; },
          .tangent = [=](double) { return direction; },
          .normal = any_normal(direction)};
}

// x = foot + R(phi) arm + rise phi n ,  ds = sqrt(r^2 + rise^2) |dphi|
Curve helix(const Vec3& centre, const Vec3& axis, const Vec3& start, double angle, double pitch) {
  const Vec3 n = axis.normalized();
  const double height = (start - centre).dot(n);
  const Vec3 foot = centre + height * n;
  const Vec3 arm = start - foot;
  const double rise = pitch / (2.0 * std::numbers::pi);
  const double length_per_angle = std::hypot(arm.norm(), rise);
  const double turn = std::copysign(1.0 / length_per_angle, angle);  // dphi / ds
  return {.length = std::abs(angle) * length_per_angle,
          .position = [=](double s) -> Vec3 {
            const double phi = turn * s;
            return foot + exp_rotation(phi * n) * arm + rise * phi * n;
          },
          .tangent = [=](double s) -> Vec3 {
            return turn * (n.cross(exp_rotation(turn * s * n) * arm) + rise * n);
          },
          .normal = n};
}

Curve spline(const std::vector<Vec3>& points) {
  const Spline curve(points);
  return {.length = curve.length(),
          .position = [=](double s) { return curve.position(s); },
          .tangent = [=](double s) { return curve.tangent(s); },
          .normal = any_normal((points.back() - points.front()).normalized())};
}

Curve arc_through(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 n = ab.cross(ac);
  // circumcentre from a
  const Vec3 to_centre =
      (ab.squaredNorm() * ac.cross(n) + ac.squaredNorm() * n.cross(ab)) / (2.0 * n.squaredNorm());
  const Vec3 first = -to_centre;
  const Vec3 last = ac - to_centre;
  double angle = std::atan2(n.normalized().dot(first.cross(last)), first.dot(last));
  if (angle < 0.0) angle += 2.0 * std::numbers::pi;
  return helix(a + to_centre, n, a, angle, 0.0);
}

}  // namespace culm::beam
