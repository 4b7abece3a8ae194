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
  // differences between both ends, of which little is left in a taut line, as products
  const double T_step = w * hanging * (V + low) / (T_high + T_low);
  const double sinh_arc = V * low > 0.0 ? w * hanging * (V + low) / (V * T_low + low * T_high)
                                        : (V * T_low - low * T_high) / (H * H);
  const double arc = std::asinh(sinh_arc);  // asinh(V / H) - asinh(low / H)
  // int sqrt(H^2 + v^2) dv / w
  const double tension =
      0.25 * hanging * (T_high + T_low) + (0.25 * (V + low) * T_step + 0.5 * H * H * arc) / w;
  // int v^2 dv / w is hanging (V^2 + V low + low^2) / 3
  const double square = H * H * L + hanging * (V * V + V * low + low * low) / 3.0;
  Complementary psi;
  psi.value = tension + grounded * H + square / (2.0 * line.stiffness);
  psi.gradient << grounded + H * arc / w + H * L / line.stiffness,
      T_step / w + 0.5 * hanging * (V + low) / line.stiffness;
  const double sines = H * H * sinh_arc / (T_high * T_low * w);
  const double cosines = -H * T_step / (T_high * T_low * w);
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

/// What friction takes from h: the stretch on the ground less that without friction, and its
/// derivatives by H and V. Over the moving length m the tension is H - C_B w s.
struct Held {
  double h = 0.0;
  Vec<2> gradient = Vec<2>::Zero();
};

Held held(const CatenaryLine& line, const Vec<2>& force) {
  const double H = force[0];
  const double fall = line.friction * line.weight;
  const double grounded = std::max(0.0, line.length - force[1] / line.weight);
  if (fall == 0.0 || grounded == 0.0) return {};
  const double m = std::min(grounded, H / fall);
  const double at_anchor = std::max(H - fall * grounded, 0.0);
  return {((m - grounded) * H - 0.5 * fall * m * m) / line.stiffness,
          Vec<2>(m - grounded, (H - at_anchor) / line.weight) / line.stiffness};
}

// On the seabed, or as deep as a fairlead gets that reaches it: a spring without weight.
CatenaryEnds lie(const CatenaryLine& line, double h) {
  CatenaryEnds ends;
  const double k = line.stiffness / line.length;
  const double stretch = std::max(0.0, h - line.length);
  ends.grounded = line.length;
  ends.energy = 0.5 * k * stretch * stretch;
  ends.found = true;
  if (stretch == 0.0) return ends;
  // H^2 / (2 C_B w EA) until the anchor feels it, then H / k less what friction holds
  const double fall = line.friction * line.weight;
  const double whole = 0.5 * fall * line.length / k;
  const double partly = std::sqrt(2.0 * fall * line.stiffness * stretch);
  ends.horizontal = stretch < whole ? partly : k * (stretch + whole);
  ends.K(0, 0) = stretch < whole ? fall * line.stiffness / partly : k;
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

// Newton's method from the line without friction. The determinant is positive for all H, V > 0.
CatenaryEnds rub(const CatenaryLine& line, double h, double z, CatenaryEnds ends) {
  const Vec<2> place(h, z);
  Vec<2> force(ends.horizontal, ends.vertical);
  const auto gap = [&](const Vec<2>& at, Mat<2, 2>& slope) {
    const Complementary psi = complementary(line, at);
    const Held less = held(line, at);
    slope = psi.hessian;
    slope.row(0) += less.gradient.transpose();
    return Vec<2>(place - psi.gradient - less.h * Vec<2>::Unit(0));
  };
  Mat<2, 2> slope;
  Vec<2> left = gap(force, slope);
  ends.found = false;
  for (int iteration = 0; iteration < 200 && !ends.found; ++iteration) {
    const Vec<2> change = slope.inverse() * left;
    if (!change.allFinite()) return ends;
    ends.found =
        std::max(std::abs(change[0]) / force[0], std::abs(change[1]) / force.norm()) < 1e-12;
    double share = 1.0;
    for (const int i : {0, 1}) {
      if (change[i] < -0.9 * force[i]) share = std::min(share, -0.9 * force[i] / change[i]);
    }
    const double size = left.norm();
    const Vec<2> start = force;
    for (int halving = 0; halving < 60; ++halving, share *= 0.5) {
      force = start + share * change;
      left = gap(force, slope);
      if (left.norm() <= size + 1e-15 * line.length) break;
    }
  }
  ends.horizontal = force[0];
  ends.vertical = force[1];
  ends.grounded = std::max(0.0, line.length - force[1] / line.weight);
  ends.K = slope.inverse();
  return ends;
}

}  // namespace

CatenaryEnds hang(const CatenaryLine& line, double h, double z) {
  if (line.on_seabed && z <= 0.0) return lie(line, h);
  if (line.on_seabed) {
    const CatenaryEnds straight = hang_straight(line, z);
    if (h <= straight.grounded) return straight;
  }
  const CatenaryEnds ends = solve(line, h, z);
  const bool rubs = line.on_seabed && line.friction > 0.0 && ends.found && ends.grounded > 0.0;
  return rubs ? rub(line, h, z, ends) : ends;
}

}  // namespace culm::load
