#include <culm/math/quadrature.hpp>
#include <culm/math/spline.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm {

namespace {

// Second derivatives at the points that make the first ones continuous: a tridiagonal system.
std::vector<Vec3> find_curvatures(const std::vector<Vec3>& points,
                                  const std::vector<double>& chords) {
  const std::size_t n = points.size();
  std::vector<Vec3> curvatures(n, Vec3::Zero());
  std::vector<double> factors(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = chords[i - 1];
    const double after = chords[i];
    const double pivot = 2.0 * (before + after) - before * factors[i - 1];
    const Vec3 bend =
        6.0 * ((points[i + 1] - points[i]) / after - (points[i] - points[i - 1]) / before);
    factors[i] = after / pivot;
    curvatures[i] = (bend - before * curvatures[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) curvatures[i] -= factors[i] * curvatures[i + 1];
  return curvatures;
}

}  // namespace

Spline::Spline(std::vector<Vec3> points) : points_(std::move(points)) {
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    chords_.push_back((points_[i + 1] - points_[i]).norm());
  }
  curvatures_ = find_curvatures(points_, chords_);
  arc_lengths_.push_back(0.0);
  for (std::size_t i = 0; i < chords_.size(); ++i) {
    arc_lengths_.push_back(arc_lengths_.back() + arc_length(i, 0.0, chords_[i]));
  }
}

Vec3 Spline::slope(const Place& at) const {
  const double h = chords_[at.piece];
  const double t = at.u / h;
  const Vec3 chord = (points_[at.piece + 1] - points_[at.piece]) / h;
  return chord + h / 6.0 *
                     ((3.0 * t * t - 1.0) * curvatures_[at.piece + 1] -
                      (3.0 * (1.0 - t) * (1.0 - t) - 1.0) * curvatures_[at.piece]);
}

double Spline::arc_length(std::size_t piece, double from, double to) const {
  constexpr int parts = 4;  // with six points each: to round-off for curves worth the name
  const double half = (to - from) / (2.0 * parts);
  double length = 0.0;
  for (int part = 0; part < parts; ++part) {
    const double middle = from + (2 * part + 1) * half;
    for (const QuadraturePoint& point : gauss_legendre(6)) {
      length += half * point.weight * slope({piece, middle + half * point.xi}).norm();
    }
  }
  return length;
}

// Newton's method on the arc length, whose derivative is the norm of the slope.
Spline::Place Spline::find(double s) const {
  const auto after = std::upper_bound(arc_lengths_.begin() + 1, arc_lengths_.end() - 1, s);
  const auto piece = static_cast<std::size_t>(after - arc_lengths_.begin()) - 1;
  const double along = s - arc_lengths_[piece];
  const double full = arc_lengths_[piece + 1] - arc_lengths_[piece];
  Place at{piece, along / full * chords_[piece]};
  constexpr int most_iterations = 20;
  for (int i = 0; i < most_iterations; ++i) {
    const double step = (along - arc_length(piece, 0.0, at.u)) / slope(at).norm();
    at.u += step;
    if (std::abs(step) <= 1e-15 * chords_[piece]) break;
  }
  return at;
}

Vec3 Spline::position(double s) const {
  const Place at = find(s);
  const double h = chords_[at.piece];
  const double t = at.u / h;
  const double r = 1.0 - t;
  return r * points_[at.piece] + t * points_[at.piece + 1] +
         h * h / 6.0 *
             ((r * r * r - r) * curvatures_[at.piece] +
              (t * t * t - t) * curvatures_[at.piece + 1]);
}

Vec3 Spline::tangent(double s) const { return slope(find(s)).normalized(); }

}  // namespace culm
