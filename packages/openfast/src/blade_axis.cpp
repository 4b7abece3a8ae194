#include "blade_axis.hpp"

#include <culm/math/quadrature.hpp>
#include <culm/math/rotation.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace culm::openfast {

namespace {

std::vector<Vec3> positions_of(const std::vector<KeyPoint>& key_points) {
  std::vector<Vec3> positions;
  for (const KeyPoint& point : key_points) positions.push_back(point.position);
  return positions;
}

bool is_straight(const std::vector<KeyPoint>& key_points) {
  const Vec3 first = key_points.front().position;
  const Vec3 chord = key_points.back().position - first;
  return std::all_of(key_points.begin(), key_points.end(), [&](const KeyPoint& point) {
    return (point.position - first).cross(chord).norm() <= 1e-9 * chord.squaredNorm();
  });
}

// Untwisted sections of BeamDyn have an x axis without component along y; Up = x makes it the
// projection of x. They differ where the axis is curved in both planes.
double turn_of_x(const Vec3& tangent) {
  const Mat3 up = triad_along(tangent, Vec3::UnitX());
  const Vec3 x = Vec3::UnitY().cross(tangent).normalized();
  return std::atan2(x.dot(up.col(1)), x.dot(up.col(0)));
}

}  // namespace

BladeAxis::BladeAxis(const std::vector<KeyPoint>& key_points)
    : curve(positions_of(key_points)), straight(is_straight(key_points)) {
  for (std::size_t i = 0; i < key_points.size(); ++i) {
    const double s = curve.arc_lengths()[i];
    spans.push_back(s / curve.length());
    angles.push_back(turn_of_x(curve.tangent(s)) - key_points[i].twist);
  }
}

BladeMass integrate_mass(const BladeAxis& axis, const std::vector<BladeStation>& stations) {
  BladeMass sum;
  const double length = axis.curve.length();
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const BladeStation& a = stations[i];
    const BladeStation& b = stations[i + 1];
    for (const QuadraturePoint& point : gauss_legendre(6)) {
      const double t = 0.5 * (1.0 + point.xi);
      const double m = (1.0 - t) * a.mass(0, 0) + t * b.mass(0, 0);
      const double weight = 0.5 * point.weight * (b.span - a.span) * length * m;
      const Vec3 x = axis.curve.position(((1.0 - t) * a.span + t * b.span) * length);
      sum.mass += weight;
      sum.first += weight * x;
      sum.second += weight * x.z() * x.z();
    }
  }
  return sum;
}

}  // namespace culm::openfast
