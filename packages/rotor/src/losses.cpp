#include <culm/rotor/losses.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace culm::rotor {
namespace {

// Multiplies a factor by Prandtl's of one end, which lies `distance` away in units of `radius`.
// @param slope  of the factor by the sine of the inflow angle
void lose_at_end(int blades, double distance, double radius, double sine, double& factor,
                 double& slope) {
  const double exponent = 0.5 * blades * std::max(distance, 0.0) / (radius * sine);
  const double left = std::exp(-exponent);
  const double share = 2.0 / std::numbers::pi * std::acos(left);
  const double share_slope =
      left < 1.0 ? -2.0 / std::numbers::pi * left * exponent / (sine * std::sqrt(1.0 - left * left))
                 : 0.0;
  slope = slope * share + factor * share_slope;
  factor *= share;
}

}  // namespace

double loss_factor(const Losses& losses, const AnnulusPlace& place, double inflow_angle) {
  double unused;
  return loss_factor(losses, place, inflow_angle, unused);
}

double loss_factor(const Losses& losses, const AnnulusPlace& place, double inflow_angle,
                   double& slope) {
  const double sine = std::sin(inflow_angle);
  const double size = std::max(std::abs(sine), 1e-12);
  double factor = 1.0;
  slope = 0.0;
  if (losses.tip) {
    lose_at_end(place.blades, place.tip_radius - place.radius, place.radius, size, factor, slope);
  }
  if (losses.hub) {
    lose_at_end(place.blades, place.radius - place.hub_radius, place.hub_radius, size, factor,
                slope);
  }
  slope *= sine < 0.0 ? -std::cos(inflow_angle) : std::cos(inflow_angle);
  if (factor > least_loss_factor) return factor;
  slope = 0.0;
  return least_loss_factor;
}

}  // namespace culm::rotor
