/// What blades of finite number and length lose.
#pragma once

namespace culm::rotor {

/// Which losses count.
struct Losses {
  bool tip = true;
  bool hub = true;
};

/// Where an annulus lies between hub and tip, and how many blades pass through it.
struct AnnulusPlace {
  int blades = 3;
  double radius = 0.0;      ///< [m]
  double hub_radius = 0.0;  ///< where blades begin [m]
  double tip_radius = 0.0;  ///< where they end [m]
};

/// Below this a loss factor would only divide by zero.
inline constexpr double least_loss_factor = 1e-4;

/// Prandtl's factor F of tip and hub, by which the momentum of an annulus is smaller than that of
/// a disc; from `least_loss_factor`, at both ends and beyond, to 1.
/// @source fluids B3
double loss_factor(const Losses& losses, const AnnulusPlace& place, double inflow_angle);
/// @param slope  its derivative by the inflow angle [1/rad]; zero at the least factor
double loss_factor(const Losses& losses, const AnnulusPlace& place, double inflow_angle,
                   double& slope);

}  // namespace culm::rotor
