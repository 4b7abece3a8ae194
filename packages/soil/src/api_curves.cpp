#include <culm/soil/api_curves.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace culm::soil {
namespace {

constexpr double far = 20.0;  // where cosh x is exp|x| / 2 to rounding

// ln cosh x, without overflow, with all digits of small values
double log_cosh(double x) {
  const double a = std::abs(x);
  if (a > far) return a - std::numbers::ln2;
  const double half = std::sinh(0.5 * a);
  return std::log1p(2.0 * half * half);
}

// ln cosh b - ln cosh a: cosh b - cosh a = 2 sinh (b + a)/2 sinh (b - a)/2
double log_cosh_between(double a, double b) {
  if (std::abs(b) < std::abs(a)) return -log_cosh_between(b, a);
  if (std::abs(b) > far) return log_cosh(b) - log_cosh(a);
  return std::log1p(2.0 * std::sinh(0.5 * (b + a)) * std::sinh(0.5 * (b - a)) / std::cosh(a));
}

double with_sign(double value, double of) { return of < 0.0 ? -value : value; }

}  // namespace

SandCoefficients SandCoefficients::of(double phi) {
  constexpr double K0 = 0.4;
  const double alpha = 0.5 * phi;
  const double beta = 0.25 * std::numbers::pi + 0.5 * phi;
  const double Ka = std::pow(std::tan(0.25 * std::numbers::pi - 0.5 * phi), 2);
  const double tb = std::tan(beta);
  const double td = std::tan(beta - phi);
  const double tp = std::tan(phi);
  return {tb * tb * std::tan(alpha) / td + K0 * (tp * std::sin(beta) / (std::cos(alpha) * td) +
                                                 tb * (tp * std::sin(beta) - std::tan(alpha))),
          tb / td - Ka, Ka * (std::pow(tb, 8) - 1.0) + K0 * tp * std::pow(tb, 4)};
}

double SandCurve::ultimate(const Sand& sand, double X, double D) {
  const auto [C1, C2, C3] = SandCoefficients::of(sand.friction_angle);
  return std::min(C1 * X + C2 * D, C3 * D) * sand.unit_weight * X;
}

SandCurve::SandCurve(const Sand& sand, double X, double D, bool cyclic)
    : limit_((cyclic ? 0.9 : std::max(0.9, 3.0 - 0.8 * X / D)) * ultimate(sand, X, D)),
      stiffness_(sand.initial_modulus * X) {}

double SandCurve::force(double y) const { return limit_ * std::tanh(stiffness_ * y / limit_); }

double SandCurve::slope(double y) const {
  const double t = std::tanh(stiffness_ * y / limit_);
  return stiffness_ * (1.0 - t * t);
}

double SandCurve::energy(double y) const {
  return limit_ * limit_ / stiffness_ * log_cosh(stiffness_ * y / limit_);
}

double SandCurve::energy_between(double from, double to) const {
  const double scale = stiffness_ / limit_;
  return limit_ / scale * log_cosh_between(scale * from, scale * to);
}

// At even steps of the force, and two that come close to the limit.
std::vector<double> SandCurve::knots() const {
  constexpr int count = 20;
  std::vector<double> knots;
  for (int i = 1; i < count; ++i) knots.push_back(std::atanh(double(i) / count));
  for (const double share : {0.99, 0.9999}) knots.push_back(std::atanh(share));
  for (double& knot : knots) knot *= limit_ / stiffness_;
  return knots;
}

double ClayCurve::ultimate(const Clay& clay, double X, double D) {
  const double c = clay.strength;
  return std::min(3.0 * c + clay.unit_weight * X + clay.J * c * X / D, 9.0 * c) * D;
}

ClayCurve::ClayCurve(const Clay& clay, double X, double D, bool cyclic)
    : ultimate_(ultimate(clay, X, D)), yc_(2.5 * clay.strain * D), start_(0.1 * yc_) {
  constexpr double of_cyclic = 0.72;
  if (!cyclic) {
    peak_ = end_ = 8.0 * yc_;
    peak_force_ = last_force_ = ultimate_;
    return;
  }
  const double XR = 6.0 * D / (clay.unit_weight * D / clay.strength + clay.J);
  // where the cube root is 0.72, near 3 y_c, so that nothing jumps
  peak_ = yc_ * std::pow(2.0 * of_cyclic, 3);
  end_ = X < XR ? 15.0 * yc_ : peak_;
  peak_force_ = of_cyclic * ultimate_;
  last_force_ = peak_force_ * std::min(1.0, X / XR);
}

double ClayCurve::cubic(double y) const { return 0.5 * ultimate_ * std::cbrt(y / yc_); }

double ClayCurve::force(double y) const {
  const double a = std::abs(y);
  if (a <= start_) return cubic(start_) / start_ * y;
  if (a < peak_) return with_sign(cubic(a), y);
  if (a >= end_) return with_sign(last_force_, y);
  const double t = (a - peak_) / (end_ - peak_);
  return with_sign((1.0 - t) * peak_force_ + t * last_force_, y);
}

double ClayCurve::slope(double y) const {
  const double a = std::abs(y);
  if (a <= start_) return cubic(start_) / start_;
  if (a < peak_) return cubic(a) / (3.0 * a);
  if (a >= end_) return 0.0;
  return (last_force_ - peak_force_) / (end_ - peak_);
}

double ClayCurve::energy(double y) const {
  const double a = std::abs(y);
  const double line = std::min(a, start_);
  double sum = 0.5 * cubic(start_) / start_ * line * line;
  if (a <= start_) return sum;
  const double root = std::min(a, peak_);
  sum += 0.75 * (cubic(root) * root - cubic(start_) * start_);
  if (a <= peak_) return sum;
  const double way = std::min(a, end_) - peak_;
  const double t = end_ > peak_ ? way / (end_ - peak_) : 0.0;
  sum += way * (peak_force_ + 0.5 * t * (last_force_ - peak_force_));
  return a <= end_ ? sum : sum + last_force_ * (a - end_);
}

// At even ratios along the cube root.
std::vector<double> ClayCurve::knots() const {
  constexpr int count = 20;
  std::vector<double> knots;
  for (int i = 0; i <= count; ++i) {
    knots.push_back(start_ * std::pow(peak_ / start_, double(i) / count));
  }
  if (end_ > peak_) knots.push_back(end_);
  return knots;
}

ShaftTable clay_shaft(double D, double residual) {
  return {{0.0, 0.0016 * D, 0.0031 * D, 0.0057 * D, 0.008 * D, 0.01 * D, 0.02 * D},
          {0.0, 0.3, 0.5, 0.75, 0.9, 1.0, residual}};
}

ShaftTable sand_shaft() { return {{0.0, 0.00254}, {0.0, 1.0}}; }

ShaftTable tip(double D) {
  return {{0.0, 0.002 * D, 0.013 * D, 0.042 * D, 0.073 * D, 0.1 * D},
          {0.0, 0.25, 0.5, 0.75, 0.9, 1.0}};
}

}  // namespace culm::soil
