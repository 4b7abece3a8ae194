#include "measure.hpp"

#include <algorithm>
#include <cmath>

namespace culm::load {
namespace {

double length(double square) { return std::max(std::sqrt(square), no_length); }

// G = 1 / (2 z_theta) with the length z_theta between the ends: Dz / D(z^2) at theta = 1/2.
void step_distance(double a, double b, double theta, MeasureStep& step) {
  const double zb = length(b);
  const double z = (1.0 - theta) * std::sqrt(a) + theta * zb;
  step.slope[0] = 0.5 / zb;
  step.gradient[0] = 0.5 / z;
  step.derivative(0, 0) = -0.25 * theta / zb / z / z;
}

// G = y_theta / z_theta
void step_radius(const Vec<2>& a, const Vec<2>& b, double theta, MeasureStep& step) {
  const double zb = length(b.squaredNorm());
  const double z = (1.0 - theta) * a.norm() + theta * zb;
  step.slope = b / zb;
  step.gradient = ((1.0 - theta) * a + theta * b) / z;
  step.derivative = theta * (Mat<2, 2>::Identity() - step.gradient * step.slope.transpose()) / z;
}

Vec<2> quarter_turn(const Vec<2>& v) { return {-v[1], v[0]}; }

double angle_between(const Vec<2>& a, const Vec<2>& b) {
  return std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
}

// From the start a = (1 - moves) y_prev + moves y_next, which makes theta the middle of the way to
// the end b; with m = (a + b) / 2, d = b - a:
// G = g + (Dz - g . d) d / |d|^2, g = J m / |m|^2.
void step_angle(const Vec<2>& y_prev, const Vec<2>& b, double theta, MeasureStep& step) {
  const double moves = 2.0 * theta - 1.0;
  const Vec<2> a = (1.0 - moves) * y_prev + moves * b;
  const Vec<2> m = 0.5 * (a + b);
  const Vec<2> d = b - a;
  const double m2 = m.squaredNorm();
  const double d2 = d.squaredNorm();
  Mat<2, 2> J;
  J << 0.0, -1.0, 1.0, 0.0;
  step.slope = quarter_turn(b) / b.squaredNorm();
  const Vec<2> g = quarter_turn(m) / m2;
  const Mat<2, 2> dg = theta * (J - 2.0 * g * m.transpose()) / m2;
  step.gradient = g;
  step.derivative = dg;
  // Dz - g . d is of third order in d; below this it is lost in round-off and does no work
  if (d2 < 1e-10) return;
  const double e = angle_between(a, b) - g.dot(d);
  const Vec<2> de = step.slope - moves * quarter_turn(a) / a.squaredNorm() - dg.transpose() * d -
                    (1.0 - moves) * g;
  step.gradient += e / d2 * d;
  step.derivative +=
      d * de.transpose() / d2 +
      (1.0 - moves) * e / d2 * (Mat<2, 2>::Identity() - 2.0 * d * d.transpose() / d2);
}

}  // namespace

double measure(Measure measure, const Vec<2>& y_prev, double z_prev, const Vec<2>& y) {
  switch (measure) {
    case Measure::component:
      return y[0];
    case Measure::distance:
      return length(y[0]);
    case Measure::radius:
      return length(y.squaredNorm());
    case Measure::angle:
      break;
  }
  return z_prev + angle_between(y_prev, y);
}

MeasureStep measure_step(Measure measure, const Vec<2>& y_prev, double z_prev, const Vec<2>& y_next,
                         double theta) {
  MeasureStep step;
  step.next = load::measure(measure, y_prev, z_prev, y_next);
  switch (measure) {
    case Measure::component:
      step.slope[0] = step.gradient[0] = 1.0;
      break;
    case Measure::distance:
      step_distance(y_prev[0], y_next[0], theta, step);
      break;
    case Measure::radius:
      step_radius(y_prev, y_next, theta, step);
      break;
    case Measure::angle:
      step_angle(y_prev, y_next, theta, step);
      break;
  }
  return step;
}

}  // namespace culm::load
