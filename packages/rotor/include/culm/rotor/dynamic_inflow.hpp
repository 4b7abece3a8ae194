/// The lag of induction behind the loads of the rotor, by Oye.
#pragma once

#include <Eigen/Core>

namespace culm::rotor {

/// Induced velocity of a station in the rotor's axes: axial, tangential [m/s].
using Induced = Eigen::Vector2d;

/// Time constants of one station [s].
struct InflowTimes {
  double slow = 0.0;  ///< tau_1, of the wake of the whole rotor
  double fast = 0.0;  ///< tau_2, of the vortices nearby; below 0.4 of the slow one
};

/// @param mean_induction  mean axial induction of the rotor; counts to 0.5
/// @param wind            mean axial wind, > 0 [m/s]
/// @param tip_radius      [m]
/// @param radius_ratio    radius of the station over that of the tip
/// @source fluids B3
InflowTimes inflow_times(double mean_induction, double wind, double tip_radius,
                         double radius_ratio);

/// What a station remembers: tau_1 W_red' = -W_red + (1 - k) W_qs and
/// tau_2 W' = -W + W_red + k W_qs with k = 0.6, where W_qs is what the balance of momentum asks
/// for.
/// @source fluids B3
struct InflowState {
  Induced reduced = Induced::Zero();  ///< W_red
  Induced induced = Induced::Zero();  ///< W, which the blades feel

  /// The state in which nothing changes.
  static InflowState steady(const Induced& quasi_steady);
  /// The state a step later; exact where W_qs is linear over the step.
  /// @param begin, end  W_qs at the ends of the step
  InflowState after(double step, const InflowTimes& times, const Induced& begin,
                    const Induced& end) const;
};

/// The share s in W = (s / (1 + tau_1 p) + (1 - s) / (1 + tau_2 p)) W_qs with p = d/dt.
double slow_share(const InflowTimes& times);

/// The part of W_qs, the same on the whole step, that W has at its end.
double inflow_response(double step, const InflowTimes& times);

}  // namespace culm::rotor
