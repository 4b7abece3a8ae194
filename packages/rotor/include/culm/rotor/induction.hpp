/// Balance of blade element and momentum in one annulus of a rotor.
#pragma once

#include <culm/math/types.hpp>
#include <culm/rotor/losses.hpp>

#include <functional>

namespace culm::rotor {

/// Lift and drag coefficients of a section by the angle of attack from -pi to pi [rad].
struct LiftDrag {
  double lift = 0.0;
  double drag = 0.0;
  double lift_slope = 0.0, drag_slope = 0.0;  ///< by that angle [1/rad]
};
using Section = std::function<LiftDrag(double)>;

/// A section of the blades, and what they meet there.
struct BladeElement {
  AnnulusPlace place;
  Losses losses;
  double chord = 0.0;        ///< [m]
  double twist = 0.0;        ///< from the plane of rotation to the chord [rad]
  double axial = 0.0;        ///< wind normal to the plane, without induction [m/s]
  double tangential = 0.0;   ///< wind against the motion, without induction [m/s]
  bool drag_induces = true;  ///< drag counts in the momentum balance
};

/// What the balance gives.
struct Induction {
  double inflow_angle = 0.0;  ///< phi, between relative wind and plane of rotation [rad]
  double axial = 0.0;         ///< a: the wind is (1 - a) times as fast
  double tangential = 0.0;    ///< a': the wind against the motion is (1 + a') times as fast
  bool found = true;          ///< false: there is no balance, and nothing is induced
  /// Of a and a' by axial and tangential wind [s/m], and by an angle that is added to that of
  /// attack [1/rad]; zero where nothing is induced.
  Mat<2, 3> slope = Mat<2, 3>::Zero();
};

/// Solves the balance of one annulus for the inflow angle, by Ning's residual with Buhl's relation
/// between thrust and induction where the rotor is heavily loaded. Where the axial or the
/// tangential wind vanishes, as on a parked rotor, nothing is induced.
/// The derivatives need those of the section; they follow from the balance as an implicit function.
/// @param near  inflow angle of a balance nearby, from where Newton's method looks first; 0: none
/// @source fluids B3; S. A. Ning, Wind Energy 17 (2014) 1327
Induction solve_induction(const BladeElement& element, const Section& section, double near = 0.0);

/// Ning's residual at an inflow angle, for axial wind >= 0; zero at the balance.
double induction_residual(const BladeElement& element, const Section& section, double inflow_angle);

/// The axial induction at which thrust and momentum balance: kappa = sigma C_n / (4 F sin^2 phi),
/// F the loss factor, for phi > 0 (wind through the rotor).
double axial_induction(double kappa, double loss_factor);

}  // namespace culm::rotor
