#include <culm/load/catenary.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace culm::load {
namespace {

/// Complementary energy Psi(H, V) = int T + T^2 / (2 EA) ds. It is convex, and its derivatives are
/// h and z.
struct Complementary {
  double value = 0.0;
  Vec<2> gradient = Vec<2>::Zero();
  Mat<2, 2> hessian = Mat<2, 2>::Zero();
};

// int sqrt(H^2 + v^2) dv from 0
double tension_integral(double H, double v) {
  return 0.5 * (v * std::hypot(H, v) + H * H * std::asinh(v / H));
}

Complementary complementary(const CatenaryLine& line, const Vec<2>& force) {
  const double H = force[0];
  const double V = force[1];
  const double w = line.weight;
  const double L = line.length;
  const double grounded = line.on_seabed ? std::max(0.0, L - V / w) : 0.0;
  const double hanging = L - grounded;
  const double low = grounded > 0.0 ? 0.0 : V - w * L;  // V at the lower end of what hangs
  const double T_high = std::hypot(H, V);
  const double T_low = std::hypot(H, low);
  const double arc = std::asinh(V / H) - std::asinh(low / H);
  // int v^2 dv / w is hanging (V^2 + V low + low^2) / 3
  const double square = H * H * L + hanging * (V * V + V * low + low * low) / 3.0;
  Complementary psi;
  psi.value = (tension_integral(H, V) - tension_integral(H, low)) / w + grounded * H +
              square / (2.0 * line.stiffness);
  psi.gradient << grounded + H * arc / w + H * L / line.stiffness,
      (T_high - T_low) / w + 0.5 * hanging * (V + low) / line.stiffness;
  const double sines = (V / T_high - low / T_low) / w;
  const double cosines = H * (1.0 / T_high - 1.0 / T_low) / w;
  psi.hessian << arc / w - sines + L / line.stiffness, cosines, cosines,
      sines + hanging / line.stiffness;
  return psi;
}

// H and V of Jonkman's first guess
Vec<2> first_guess(const CatenaryLine& line, double h, double z) {
  const double L = line.length;
  const double ratio = (L * L - z * z) / (h * h);
  const double lambda = ratio > 1.0 ? std::sqrt(3.0 * (ratio - 1.0)) : 0.2;
  const double H = 0.5 * line.weight * h / lambda;
  return {H, 0.5 * line.weight * (z / std::tanh(lambda) + L)};
}

// On the seabed, or as deep as a fairlead gets that reaches it: a spring without weight.
CatenaryEnds lie(const CatenaryLine& line, double h) {
  CatenaryEnds ends;
  const double k = line.stiffness / line.length;
  const double stretch = std::max(0.0, h - line.length);
  ends.horizontal = k * stretch;
  ends.grounded = line.length;
  ends.energy = 0.5 * k * stretch * stretch;
  if (stretch > 0.0) ends.K(0, 0) = k;
  ends.found = true;
  return ends;
}

// Straight down, with what is left of it slack on the seabed.
CatenaryEnds hang_straight(const CatenaryLine& line, double z) {
  CatenaryEnds ends;
  const double w = line.weight;
  const double root = std::sqrt(1.0 + 2.0 * z * w / line.stiffness);
  const double V = 2.0 * z * w / (1.0 + root);
  ends.vertical = V;
  ends.grounded = line.length - V / w;
  ends.energy = V * z - V * V * (0.5 + V / (6.0 * line.stiffness)) / w;
  ends.K(1, 1) = w / root;
  ends.found = true;
  return ends;
}

// Newton's method for the largest H h + V z - Psi: a concave function, so shorter steps always
// lead there. H stays positive, and so does V of a line on the seabed.
CatenaryEnds solve(const CatenaryLine& line, double h, double z) {
  const Vec<2> place(h, z);
  Vec<2> force = first_guess(line, h, z);
  Complementary psi = complementary(line, force);
  CatenaryEnds ends;
  for (int iteration = 0; iteration < 200 && !ends.found; ++iteration) {
    const Vec<2> slope = place - psi.gradient;
    Vec<2> change = psi.hessian.inverse() * slope;
    if (!change.allFinite()) return ends;
    const double size = std::max(std::abs(change[0]) / force[0],
                                 std::abs(change[1]) / force.lpNorm<Eigen::Infinity>());
    double share = 1.0;
    if (change[0] < -0.9 * force[0]) share = -0.9 * force[0] / change[0];
    if (line.on_seabed && change[1] < -0.9 * force[1]) {
      share = std::min(share, -0.9 * force[1] / change[1]);
    }
    const double value = force.dot(place) - psi.value;
    const double noise = 1e-13 * (std::abs(force.dot(place)) + std::abs(psi.value));
    for (int halving = 0; halving < 60; ++halving, share *= 0.5) {
      const Vec<2> trial = force + share * change;
      psi = complementary(line, trial);
      if (trial.dot(place) - psi.value < value - noise) continue;
      force = trial;
      break;
    }
    ends.found = size < 1e-12 || slope.lpNorm<Eigen::Infinity>() < 1e-15 * line.length;
  }
  ends.horizontal = force[0];
  ends.vertical = force[1];
  if (line.on_seabed) ends.grounded = std::max(0.0, line.length - force[1] / line.weight);
  ends.energy = force.dot(place) - psi.value;
  ends.K = psi.hessian.inverse();
  return ends;
}

}  // namespace

CatenaryEnds hang(const CatenaryLine& line, double h, double z) {
  if (line.on_seabed && z <= 0.0) return lie(line, h);
  if (line.on_seabed) {
    const CatenaryEnds straight = hang_straight(line, z);
    if (h <= straight.grounded) return straight;
  }
  return solve(line, h, z);
}

}  // namespace culm::load
