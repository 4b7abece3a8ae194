#include <culm/contact/repulsion.hpp>

#include <algorithm>
#include <cmath>

namespace culm::contact {

Repulsion Repulsion::of_lines(double reach, double line_force, double depth, double damping) {
  const double distance = reach - depth;
  const double inside = reach * reach - distance * distance;
  return {reach, 3.0 * line_force / (16.0 * distance * std::pow(inside, 1.5)), damping};
}

double Repulsion::energy(double y) const {
  const double inside = std::max(reach * reach - y, 0.0);
  return strength * inside * inside;
}

// With c = R^2 - y, and <c> = max(c, 0), the mean is -K (<c1>^2 - <c0>^2) / (c1 - c0). Written by
// the share of the way that lies within the reach nothing cancels. Where the new strain has more
// weight than one half, energy is only taken, as it is convex.
RepulsionResponse respond(const Repulsion& law, double prev, double next, const Stencil& stencil) {
  const double K = law.strength;
  const double end = 2.0 * stencil.theta_strain - 1.0;
  const double c0 = law.reach * law.reach - prev;
  const double c1 = law.reach * law.reach - next;
  const double in1 = std::max(c1, 0.0);
  double S = -2.0 * end * K * in1;
  double slope = in1 > 0.0 ? 2.0 * end * K : 0.0;
  if (c0 > 0.0 && c1 > 0.0) {
    S -= (1.0 - end) * K * (c0 + c1);
    slope += (1.0 - end) * K;
  } else if (c0 > 0.0 || c1 > 0.0) {
    const double in = std::max(c0, c1);
    const double way = in - std::min(c0, c1);
    const double share = in / way;
    S -= (1.0 - end) * K * in * share;
    slope += (1.0 - end) * K * (c1 > 0.0 ? share * (2.0 - share) : share * share);
  }
  if (stencil.step == 0.0 || law.damping == 0.0) return {S, S, slope};
  const double rate = (std::sqrt(prev) - std::sqrt(next)) / stencil.step;
  const double factor = 1.0 + law.damping * rate;
  if (factor <= 0.0) return {S, 0.0, 0.0};
  return {S, factor * S, factor * slope - S * law.damping / (2.0 * std::sqrt(next) * stencil.step)};
}

}  // namespace culm::contact
