#include "measure.hpp"

#include <algorithm>
#include <cmath>

namespace culm::load {
namespace {

double length(double square) { return std::max(std::sqrt(square), no_length); }

// G = 1 / (z_a + z_b): Dz / D(z^2). The start moves with (2 theta - 1) of the end.
void step_distance(double a, double b, double moves, MeasureStep& step) {
  const double za = length(a);
  const double zb = length(b);
  const double sum = za + zb;
  step.slope[0] = 0.5 / zb;
  step.gradient[0] = 1.0 / sum;
  step.derivative(0, 0) = -(0.5 / zb + moves * 0.5 / za) / sum / sum;
}

// G = (a + b) / (z_a + z_b)
void step_radius(const Vec<2>& a, const Vec<2>& b, double moves, MeasureStep& step) {
  const double za = length(a.squaredNorm());
  const double zb = length(b.squaredNorm());
  const double sum = za + zb;
  step.slope = b / zb;
  step.gradient = (a + b) / sum;
  step.derivative = ((1.0 + moves) * Mat<2, 2>::Identity() -
                     step.gradient * (step.slope + moves * a / za).transpose()) /
                    sum;
}

Vec<2> quarter_turn(const Vec<2>& v) { return {-v[1], v[0]}; }

double angle_between(const Vec<2>& a, const Vec<2>& b) {
  return std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
}

// With m = (a + b) / 2, d = b - a: G = g + (Dz - g . d) d / |d|^2, g = J m / |m|^2.
void step_angle(const Vec<2>& a, const Vec<2>& b, double moves, MeasureStep& step) {
  const double theta = 0.5 * (1.0 + moves);
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
  const double moves = 2.0 * theta - 1.0;
  const Vec<2> start = (1.0 - moves) * y_prev + moves * y_next;
  switch (measure) {
    case Measure::component:
      step.slope[0] = step.gradient[0] = 1.0;
      break;
    case Measure::distance:
      step_distance(start[0], y_next[0], moves, step);
      break;
    case Measure::radius:
      step_radius(start, y_next, moves, step);
      break;
    case Measure::angle:
      step_angle(start, y_next, moves, step);
      break;
  }
  return step;
}

}  // namespace culm::load
