#include <culm/rotor/losses.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace culm::rotor {
namespace {

// Prandtl's factor of one end, which lies `distance` away in units of `radius`.
double end_factor(int blades, double distance, double radius, double sine) {
  const double exponent = 0.5 * blades * std::max(distance, 0.0) / (radius * sine);
  return 2.0 / std::numbers::pi * std::acos(std::exp(-exponent));
}

}  // namespace

double loss_factor(const Losses& losses, const AnnulusPlace& place, double inflow_angle) {
  const double sine = std::max(std::abs(std::sin(inflow_angle)), 1e-12);
  double factor = 1.0;
  if (losses.tip)
    factor *= end_factor(place.blades, place.tip_radius - place.radius, place.radius, sine);
  if (losses.hub)
    factor *= end_factor(place.blades, place.radius - place.hub_radius, place.hub_radius, sine);
  return std::max(factor, least_loss_factor);
}

}  // namespace culm::rotor
