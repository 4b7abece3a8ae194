#include <culm/strip/separation.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace culm::strip {
namespace {

// within which the lift of an airfoil passes zero, and its attached flow is looked for [rad]
constexpr double range = std::numbers::pi / 6.0;
// of the lift of an attached flow is left when nothing is attached
constexpr double separated_share = 0.25;

// The zero of the lift that is nearest to an angle of zero, where it rises.
std::optional<double> find_zero(std::span<const LiftPoint> curve) {
  std::optional<double> best;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const LiftPoint &low = curve[i - 1], &high = curve[i];
    if (low.lift > 0.0 || high.lift <= 0.0) continue;
    const double zero = low.alpha - low.lift * (high.alpha - low.alpha) / (high.lift - low.lift);
    if (std::abs(zero) <= range && (!best || std::abs(zero) < std::abs(*best))) best = zero;
  }
  return best;
}

}  // namespace

std::optional<Separation> find_separation(std::span<const LiftPoint> curve) {
  const auto zero = find_zero(curve);
  if (!zero) return {};
  Separation found{*zero};
  for (const LiftPoint& point : curve) {
    const double away = point.alpha - *zero;
    if (away == 0.0 || std::abs(away) > range) continue;
    found.slope = std::max(found.slope, point.lift / away);
  }
  found.first = curve.front().alpha;
  found.last = curve.back().alpha;
  for (const LiftPoint& point : curve) {
    if (point.lift / found.attached(point.alpha) > separated_share) continue;
    if (point.alpha < *zero) found.first = std::max(found.first, point.alpha);
    if (point.alpha > *zero) found.last = std::min(found.last, point.alpha);
  }
  return found;
}

// With P the lift of an attached flow and r = sqrt f:
//   r = 2 sqrt(C_l / P) - 1      C_s = (C_l - f P) / (1 - f) = P (1 + 3 r) / (4 (1 + r))
Attachment Separation::at(double alpha, double lift, double lift_slope) const {
  const double P = attached(alpha);
  const bool at_zero = std::abs(P) < 1e-9;
  const double quotient = at_zero ? lift_slope / slope : lift / P;
  if (quotient >= 1.0) return {1.0, 0.0, 1.0, 0.0, 0.5 * lift, 0.5 * lift_slope};
  if (quotient <= separated_share || alpha <= first || alpha >= last) {
    return {0.0, 0.0, 0.0, 0.0, lift, lift_slope};
  }
  Attachment result;
  const double r = 2.0 * std::sqrt(quotient) - 1.0;
  result.root = r;
  result.root_slope = at_zero ? 0.0 : (lift_slope - quotient * slope) / (P * std::sqrt(quotient));
  result.share = r * r;
  result.share_slope = 2.0 * r * result.root_slope;
  const double part = (1.0 + 3.0 * r) / (4.0 * (1.0 + r));
  result.separated = P * part;
  result.separated_slope = slope * part + P * result.root_slope / (2.0 * (1.0 + r) * (1.0 + r));
  return result;
}

}  // namespace culm::strip
