#include <culm/contact/penalty.hpp>

#include <algorithm>
#include <cmath>

namespace culm::contact {
namespace {

// Integrates over the path from 0 to 1, piece by piece between the places where the law changes.
// With two Gauss points each piece is exact up to the third degree, and nothing cancels.
template <class Integrand>
double integrate(const Penalty& law, double prev, double next, Integrand integrand) {
  constexpr double gauss = 0.28867513459481288;
  const double half = 0.5 * law.smoothing;
  double ends[] = {0.0, 0.0, 0.0, 1.0};
  if (next != prev) {
    ends[1] = std::clamp((-half - prev) / (next - prev), 0.0, 1.0);
    ends[2] = std::clamp((half - prev) / (next - prev), 0.0, 1.0);
    if (ends[1] > ends[2]) std::swap(ends[1], ends[2]);
  }
  double sum = 0.0;
  for (int piece = 0; piece < 3; ++piece) {
    const double length = ends[piece + 1] - ends[piece];
    const double middle = 0.5 * (ends[piece] + ends[piece + 1]);
    for (const double s : {middle - gauss * length, middle + gauss * length}) {
      sum += 0.5 * length * integrand(s, prev + s * (next - prev));
    }
  }
  return sum;
}

}  // namespace

double Penalty::energy(double depth) const {
  const double half = 0.5 * smoothing;
  if (depth <= -half) return 0.0;
  if (depth < half) return stiffness * std::pow(depth + half, 3) / (6.0 * smoothing);
  return 0.5 * stiffness * (depth * depth + half * half / 3.0);
}

double Penalty::pressure(double depth) const {
  const double half = 0.5 * smoothing;
  if (depth <= -half) return 0.0;
  if (depth < half) return 0.5 * stiffness * (depth + half) * (depth + half) / smoothing;
  return stiffness * depth;
}

double Penalty::slope(double depth) const {
  const double half = 0.5 * smoothing;
  if (depth <= -half) return 0.0;
  if (depth < half) return stiffness * (depth + half) / smoothing;
  return stiffness;
}

// Where the new strain has more weight than one half, the stress is between the mean and that of
// the end: energy is only taken, as it is convex.
PenaltyResponse respond(const Penalty& law, double prev, double next, const Stencil& stencil) {
  const double end = 2.0 * stencil.theta_strain - 1.0;
  double elastic = end * law.pressure(next);
  double tangent = end * law.slope(next);
  if (end != 1.0) {
    elastic += (1.0 - end) * integrate(law, prev, next,
                                       [&](double, double depth) { return law.pressure(depth); });
    tangent += (1.0 - end) * integrate(law, prev, next, [&](double s, double depth) {
                 return s * law.slope(depth);
               });
  }
  if (stencil.step == 0.0 || law.damping == 0.0) return {elastic, elastic, tangent};
  const double factor = 1.0 + law.damping * (next - prev) / stencil.step;
  if (factor <= 0.0) return {elastic, 0.0, 0.0};
  return {elastic, factor * elastic, factor * tangent + elastic * law.damping / stencil.step};
}

}  // namespace culm::contact
