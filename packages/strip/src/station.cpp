#include <culm/strip/strip_load.hpp>

namespace culm::strip {

Coefficients Station::coefficients(double alpha, Coefficients& slope) const {
  const Coefficients one = airfoil->at(alpha, slope);
  if (blend == 0.0) return one;
  Coefficients next_slope;
  const Coefficients next = next_airfoil->at(alpha, next_slope);
  slope += blend * (next_slope - slope);
  return one + blend * (next - one);
}

std::array<double, StationState::size> StationState::numbers() const {
  const Vec3 &c = coefficients, &f = resultant.force, &m = resultant.moment;
  return {angle,    effective_angle,
          speed,    c[0],
          c[1],     c[2],
          normal,   tangential,
          attached, f[0],
          f[1],     f[2],
          m[0],     m[1],
          m[2],     inflow_angle,
          axial,    tangential_induction};
}

void StationState::set(std::span<const double> values) {
  angle = values[0];
  effective_angle = values[1];
  speed = values[2];
  coefficients = Vec3(values.data() + 3);
  normal = values[6];
  tangential = values[7];
  attached = values[8];
  resultant = {Vec3(values.data() + 9), Vec3(values.data() + 12)};
  inflow_angle = values[15];
  axial = values[16];
  tangential_induction = values[17];
}

}  // namespace culm::strip
