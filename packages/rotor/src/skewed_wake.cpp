#include <culm/rotor/skewed_wake.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace culm::rotor {

double wake_skew(double yaw, double mean_induction) { return (1.0 + 0.6 * mean_induction) * yaw; }

double skew_factor(double wake_skew, double radius_ratio, double azimuth) {
  const double tangent = std::clamp(std::tan(0.5 * wake_skew), -1.0, 1.0);
  return 1.0 + 15.0 * std::numbers::pi / 32.0 * radius_ratio * tangent * std::cos(azimuth);
}

}  // namespace culm::rotor
