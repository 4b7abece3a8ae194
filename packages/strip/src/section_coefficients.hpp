/// Coefficients of a section that stands between two airfoils: in a steady flow, and with dynamic
/// stall.
#pragma once

#include <culm/strip/strip_load.hpp>

#include "carried_number.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace culm::strip {

template <class Number>
struct SectionCoefficients {
  Number lift, drag, moment;
};

template <class Number>
SectionCoefficients<Number> steady(const Airfoil& airfoil, const Number& alpha) {
  Coefficients slope;
  const Coefficients value = airfoil.at(value_of(alpha), slope);
  return {chain(alpha, value[0], slope[0]), chain(alpha, value[1], slope[1]),
          chain(alpha, value[2], slope[2])};
}

/// With what the share of another one brings.
template <class Number>
SectionCoefficients<Number> blended(const SectionCoefficients<Number>& one,
                                    const SectionCoefficients<Number>& other, double share) {
  return {one.lift + share * (other.lift - one.lift), one.drag + share * (other.drag - one.drag),
          one.moment + share * (other.moment - one.moment)};
}

/// Of both airfoils of a station.
template <class Number>
SectionCoefficients<Number> steady(const Station& station, const Number& alpha) {
  const SectionCoefficients<Number> one = steady(*station.airfoil, alpha);
  if (station.blend == 0.0) return one;
  return blended(one, steady(*station.next_airfoil, alpha), station.blend);
}

/// What stall depends on.
template <class Number>
struct StallInput {
  Stall stall;
  Number angle;      ///< of attack at the three-quarter chord [rad]
  Number effective;  ///< the same behind the lag [rad]
  Number tilt;       ///< their difference [rad]
  Number speed;      ///< [m/s]
  Number turning;    ///< nose up [rad/s]
  double step;       ///< zero in statics [s]
  /// What share of a change of their targets states follow in statics.
  PerStateKind follow;
};

/// Half a chord over the speed, within what models of stall are good for [s].
template <class Number>
Number stall_time(double chord, const Number& speed) {
  const double limits[] = {0.001, 50.0};
  const Number time = 0.5 * chord / speed;
  if (value_of(time) < limits[0]) return Number(limits[0]);
  if (value_of(time) > limits[1]) return Number(limits[1]);
  return time;
}

/// In which the attached flow builds up its lift [s].
template <class Number>
Number pressure_time(double chord, const Number& speed) {
  return Number(1.7 * stall_time(chord, speed));
}

/// In which the attached share of the chord follows [s].
template <class Number>
Number attached_time(Stall stall, double chord, const Number& speed) {
  return Number((stall == Stall::four_states ? 3.0 : 6.0) * stall_time(chord, speed));
}

/// The share of dynamic stall: none beyond angles for which it was not made.
template <class Number>
Number stall_share(const Number& angle) {
  constexpr double whole = std::numbers::pi / 4.0, fade = std::numbers::pi / 36.0;
  const double beyond = std::clamp((std::abs(value_of(angle)) - whole) / fade, 0.0, 1.0);
  const double slope = 6.0 * beyond * (1.0 - beyond) / fade;
  return chain(angle, 1.0 - beyond * beyond * (3.0 - 2.0 * beyond),
               std::copysign(slope, -value_of(angle)));
}

template <class Number>
Number attached_share(const Airfoil& airfoil, const Number& alpha) {
  Coefficients slope;
  const Coefficients value = airfoil.at(value_of(alpha), slope);
  const Attachment found = airfoil.separation()->at(value_of(alpha), value[0], slope[0]);
  return chain(alpha, found.share, found.share_slope);
}

/// The root of a share, whose derivative is left out where it has none.
template <class Number>
Number root_of_share(const Number& share) {
  const double value = std::sqrt(std::max(0.0, value_of(share)));
  return chain(share, value, value > 1e-4 ? 0.5 / value : 0.0);
}

/// Of one airfoil that can stall.
/// @param attached, pressure  states at the start of the step, then at its end
/// @source fluids B4
template <class Number>
SectionCoefficients<Number> stalled(const Airfoil& airfoil, double chord,
                                    const StallInput<Number>& input, double& attached,
                                    double& pressure) {
  const Separation& separation = *airfoil.separation();
  const Number& alpha = input.effective;
  const Number time = stall_time(chord, input.speed);
  const Number potential = separation.slope * (alpha - separation.zero_lift);
  const bool four = input.stall == Stall::four_states;
  Number followed = alpha;
  const Number carried = time * input.turning;  // by the turn of the section, over pi
  if (four) {
    const Number built = relaxed<Number>(Number(potential + std::numbers::pi * carried),
                                         pressure_time(chord, input.speed), input.step,
                                         input.follow[state_kind::pressure], pressure);
    followed = Number(built / separation.slope + separation.zero_lift);
  }
  const Number share = relaxed<Number>(attached_share(airfoil, followed),
                                       attached_time(input.stall, chord, input.speed), input.step,
                                       input.follow[state_kind::attached], attached);
  Coefficients slope;
  const Coefficients value = airfoil.at(value_of(alpha), slope);
  const Attachment here = separation.at(value_of(alpha), value[0], slope[0]);
  const Number separated = chain(alpha, here.separated, here.separated_slope);
  SectionCoefficients<Number> result;
  result.lift = share * potential + (1.0 - share) * separated;
  result.drag = chain(alpha, value[1], slope[1]) + input.tilt * result.lift;
  result.moment = chain(alpha, value[2], slope[2]);
  if (!four) return result;
  Coefficients unused;
  const double least = airfoil.at(separation.zero_lift, unused)[1];
  const Number root_missing = chain(alpha, here.root, here.root_slope) - root_of_share(share);
  const Number missing = chain(alpha, here.share, here.share_slope) - share;
  result.drag += carried * result.lift +
                 (chain(alpha, value[1], slope[1]) - least) * (0.5 * root_missing - 0.25 * missing);
  result.lift += std::numbers::pi * carried;
  result.moment -= (0.5 * std::numbers::pi) * carried;
  return result;
}

/// Of both airfoils of a station; those that cannot stall keep their steady coefficients.
/// @param memory  at the start of the step, then at its end
template <class Number>
SectionCoefficients<Number> stalled(const Station& station, const StallInput<Number>& input,
                                    SectionStates& memory) {
  const auto one_of = [&](const Airfoil& airfoil, std::size_t which) {
    if (airfoil.separation() == nullptr) {
      SectionCoefficients<Number> found = steady(airfoil, input.effective);
      found.drag += input.tilt * found.lift;
      return found;
    }
    return stalled(airfoil, station.chord, input, memory.attached[which], memory.pressure[which]);
  };
  SectionCoefficients<Number> found = one_of(*station.airfoil, 0);
  if (station.blend > 0.0) {
    found = blended(found, one_of(*station.next_airfoil, 1), station.blend);
  }
  const Number share = stall_share(input.angle);
  if (value_of(share) == 1.0) return found;
  const SectionCoefficients<Number> at_once = steady(station, input.angle);
  return {at_once.lift + share * (found.lift - at_once.lift),
          at_once.drag + share * (found.drag - at_once.drag),
          at_once.moment + share * (found.moment - at_once.moment)};
}

}  // namespace culm::strip
