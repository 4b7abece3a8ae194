/// Forces of a flow on one section per length, with their derivatives where numbers carry them.
#pragma once

#include <culm/strip/strip_load.hpp>

#include "section_coefficients.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace culm::strip {

template <class Number>
using Vector = Eigen::Matrix<Number, 3, 1>;

template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  Number sum = a[0] * b[0];
  sum += a[1] * b[1];
  sum += a[2] * b[2];
  return sum;
}

/// Position of the axis, unit vector along the chord in the reference, and one across, towards the
/// suction side; or their velocities, or accelerations.
template <class Number>
struct SectionVectors {
  Vector<Number> axis, chord, normal;
};

template <class Number>
struct SectionMotion {
  SectionVectors<Number> place, velocity, acceleration;
};

/// What a section knows of the flow and of the step.
template <class Number>
struct Surroundings {
  double density = 0.0;
  Vector<Number> wind_at_force, wind_at_angle;
  double step = 0.0;     ///< zero in statics
  SectionStates memory;  ///< at the start of the step
  /// What share of a change of their targets states follow in statics.
  PerStateKind follow{};
};

/// What follows from it. The forces act on the vectors of the section: f . dx + g . dc + h . dn.
template <class Number>
struct SectionLoads {
  SectionVectors<Number> forces;
  SectionStates memory;  ///< at the end of the step
  StationState seen;
};

/// Wind slower than this brings no load: its angle has no meaning [m/s].
constexpr double no_wind = 1e-9;

/// Adds a force at a point eta behind the axis.
template <class Number>
void add_at(double eta, const Vector<Number>& force, SectionVectors<Number>& forces) {
  forces.axis += force;
  forces.chord += Number(eta) * force;
}

/// Adds a moment, nose up, as a couple on chord and normal: its power is moment times angular
/// velocity.
template <class Number>
void add_moment(const Number& moment, const Vector<Number>& c, const Vector<Number>& n,
                const Number& chord_norm, SectionVectors<Number>& forces) {
  const Number half = 0.5 * moment / chord_norm;
  forces.chord -= half * n;
  forces.normal += half * c;
}

/// The delay of a state of the lag [s].
template <class Number>
Number lag_time(const Lag& lag, std::size_t state, double half_chord, const Number& speed) {
  return (half_chord / lag.rate[state]) / speed;
}

/// The downwash behind the lag.
template <class Number>
Number lagged(const Lag& lag, const Number& downwash, const Number& speed, double half_chord,
              const Surroundings<Number>& around, std::array<double, Lag::max_states>& states) {
  Number effective = downwash;
  for (std::size_t i = 0; i < static_cast<std::size_t>(lag.states); ++i) {
    const Number target = lag.amplitude[i] * downwash;
    const Number delay = lag_time(lag, i, half_chord, speed);
    const double follow = around.follow[state_kind::first_lag + i];
    effective += relaxed<Number>(target, delay, around.step, follow, states[i]) - target;
  }
  return effective;
}

/// @source fluids B2
template <class Number>
SectionLoads<Number> section_loads(const Station& station, const StripModel& model,
                                   const SectionMotion<Number>& motion,
                                   const Surroundings<Number>& around) {
  using std::sqrt;
  SectionLoads<Number> loads;
  loads.memory = around.memory;
  const Vector<Number> zero = Vector<Number>::Constant(Number(0.0));
  SectionVectors<Number>& forces = loads.forces;
  forces = {zero, zero, zero};

  const Number chord_norm = sqrt(dot(motion.place.chord, motion.place.chord));
  const Vector<Number> c = motion.place.chord / chord_norm;
  Vector<Number> n = motion.place.normal - dot(motion.place.normal, c) * c;
  n = Vector<Number>(n / sqrt(dot(n, n)));
  const double b = 0.5 * station.chord;
  const auto velocity_at = [&](double eta) -> Vector<Number> {
    return motion.velocity.axis + Number(eta) * motion.velocity.chord;
  };
  const Number turning = -dot(motion.velocity.chord, n) / chord_norm;  // nose up

  const Vector<Number> wind = around.wind_at_angle - velocity_at(station.behind(station.angle_at));
  const Number along = dot(wind, c);
  const Number across = dot(wind, n);
  const Number speed_squared = along * along + across * across;
  if (value_of(speed_squared) > no_wind * no_wind) {
    const Number speed = sqrt(speed_squared);
    const Number effective = lagged(model.lag, across, speed, b, around, loads.memory.lag);
    const Number alpha = angle_of(effective, along);
    const Number angle = angle_of(across, along);
    // the lift is normal to the wind that it follows
    const Number tilt =
        angle_of(Number(along * (across - effective)), Number(along * along + across * effective));
    SectionCoefficients<Number> found;
    if (model.stall == Stall::none) {
      found = steady(station, alpha);
      found.drag += tilt * found.lift;
    } else {
      const StallInput<Number> input{model.stall, angle,   alpha,       tilt,
                                     speed,       turning, around.step, around.follow};
      found = stalled(station, input, loads.memory);
    }
    const Number &lift = found.lift, &drag = found.drag;
    const Number pressure = (0.5 * around.density * station.chord) * speed_squared;

    const Vector<Number> wind_there =
        around.wind_at_force - velocity_at(station.behind(station.force_at));
    Number wc = dot(wind_there, c);
    Number wn = dot(wind_there, n);
    const Number size = sqrt(Number(wc * wc + wn * wn));
    if (value_of(size) > no_wind) {
      wc = Number(wc / size);
      wn = Number(wn / size);
      const Number tangential = pressure * (drag * wc - lift * wn);
      const Number normal = pressure * (lift * wc + drag * wn);
      add_at<Number>(station.behind(station.force_at), tangential * c + normal * n, forces);
      loads.seen.normal = value_of(normal);
      loads.seen.tangential = value_of(tangential);
    }
    add_moment<Number>(pressure * station.chord * found.moment, c, n, chord_norm, forces);
    loads.seen.angle = value_of(angle);
    loads.seen.effective_angle = value_of(alpha);
    loads.seen.speed = value_of(speed);
    loads.seen.coefficients = {value_of(lift), value_of(drag), value_of(found.moment)};
    if (model.stall != Stall::none) {
      loads.seen.attached =
          std::lerp(loads.memory.attached[0], loads.memory.attached[1], station.blend);
    }
    if (model.apparent_mass) {
      const Number force = (std::numbers::pi * around.density * b * b) * speed * turning;
      add_at<Number>(station.behind(0.75), force * n, forces);
    }
  }
  if (model.apparent_mass) {
    const double mass = std::numbers::pi * around.density * b * b;
    const Vector<Number> middle =
        motion.acceleration.axis + Number(station.behind(0.5)) * motion.acceleration.chord;
    const Number force = -mass * dot(middle, n);
    add_at<Number>(station.behind(0.5), force * n, forces);
    const Number turning_rate = -dot(motion.acceleration.chord, n) / chord_norm;
    add_moment<Number>(Number((-mass * b * b / 8.0) * turning_rate), c, n, chord_norm, forces);
  }
  return loads;
}

}  // namespace culm::strip
