/// Rotors that the wind meets at an angle.
#pragma once

namespace culm::rotor {

/// The angle of the wake of a rotor whose axis is `yaw` from the wind, with its mean axial
/// induction. [rad] @source fluids B3
double wake_skew(double yaw, double mean_induction);

/// Factor on the axial induction by Pitt and Peters: more on the side that lies downwind.
/// @param radius_ratio  radius of the station over that of the tip
/// @param azimuth       of the station from where a blade is most downwind [rad]
/// @source fluids B3
double skew_factor(double wake_skew, double radius_ratio, double azimuth);

}  // namespace culm::rotor
