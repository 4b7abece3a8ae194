#include "determinant_zero.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace culm::analysis {

double approach_zero(const solver::Determinant& at_start, const solver::Determinant& at_end,
                     double length,
                     const std::function<std::optional<solver::Determinant>(double)>& at) {
  const auto relative = [&](const solver::Determinant& d) {
    return d.sign * std::exp(std::clamp(d.log_size - at_start.log_size, -600.0, 600.0));
  };
  double near = 0.0, far = length;
  double at_near = relative(at_start), at_far = relative(at_end);
  if (at_near * at_far >= 0.0) return 0.0;  // two zeros that the signs do not tell
  constexpr int most_points = 20;
  constexpr double close = 1e-6;  // over the length, and over the smaller determinant
  const double small = close * std::min(std::abs(at_near), std::abs(at_far));
  double last = 0.0;
  int same_side = 0;
  for (int i = 0; i < most_points && far - near > close * length; ++i) {
    double share = std::clamp(at_near / (at_near - at_far), 0.01, 0.99);
    if (std::abs(same_side) > 2) share = 0.5;
    const double place = near + share * (far - near);
    const std::optional<solver::Determinant> determinant = at(place);
    if (!determinant) break;
    last = place;
    const double value = relative(*determinant);
    if (std::abs(value) < small) break;
    if (value * at_near > 0.0) {
      near = place;
      at_near = value;
      same_side = std::max(same_side, 0) + 1;
      if (same_side > 1) at_far *= 0.5;
    } else {
      far = place;
      at_far = value;
      same_side = std::min(same_side, 0) - 1;
      if (same_side < -1) at_near *= 0.5;
    }
  }
  return last;
}

}  // namespace culm::analysis
