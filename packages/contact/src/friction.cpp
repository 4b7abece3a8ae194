#include <culm/contact/friction.hpp>

#include <cmath>

namespace culm::contact {

Rubbing rub(const Friction& friction, double normal, const Vec3& way, double step) {
  const Vec3 v = way / step;
  const double size = std::sqrt(v.squaredNorm() + friction.slip * friction.slip);
  const double mu = friction.coefficient;
  return {-mu * normal / size * v,
          -mu * normal / (size * step) * (Mat3::Identity() - v * v.transpose() / (size * size)),
          -mu / size * v};
}

Rubbing stick(const Friction& friction, double normal, double stiffness, const Vec3& way) {
  constexpr double rounding = 1e-12;
  const double limit = friction.coefficient * normal;
  const double size = way.norm();
  if (stiffness * size <= limit * (1.0 + rounding)) {
    return {-stiffness * way, -stiffness * Mat3::Identity(), Vec3::Zero()};
  }
  const Vec3 n = way / size;
  return {-limit * n, -limit / size * (Mat3::Identity() - n * n.transpose()),
          -friction.coefficient * n};
}

}  // namespace culm::contact
