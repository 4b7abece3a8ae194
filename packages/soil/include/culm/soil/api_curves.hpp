/// Curves of API RP 2A-WSD (2000), section 6.7 and 6.8, and ISO 19901-4, for piles in sand and
/// clay.
#pragma once

#include <culm/soil/curve.hpp>

namespace culm::soil {

/// Sand around a pile, all constants positive.
struct Sand {
  double friction_angle = 0.0;   ///< [rad]
  double unit_weight = 0.0;      ///< effective [N/m^3]
  double initial_modulus = 0.0;  ///< growth of the initial stiffness by depth [N/m^3]
};

/// C1, C2, C3 of the ultimate resistance of sand [-]
struct SandCoefficients {
  double C1 = 0.0;
  double C2 = 0.0;
  double C3 = 0.0;
  static SandCoefficients of(double friction_angle);
};

/// Clay around a pile.
struct Clay {
  double strength = 0.0;     ///< undrained, at the depth [N/m^2]
  double unit_weight = 0.0;  ///< effective [N/m^3]
  double strain = 0.0;       ///< at half of the strength, epsilon_50 [-]
  double J = 0.0;            ///< [-]
};

/// p = A p_u tanh(k X y / (A p_u)), A = max(0.9, 3 - 0.8 X / D), 0.9 for cyclic loads, with
/// p_u = min((C1 X + C2 D) w X, C3 D w X).
class SandCurve final : public Curve {
 public:
  /// @param depth [m] @param diameter of the pile [m]
  SandCurve(const Sand& sand, double depth, double diameter, bool cyclic);
  double force(double y) const override;
  double slope(double y) const override;
  double energy(double y) const override;
  std::vector<double> knots() const override;

  /// p_u [N/m]
  static double ultimate(const Sand& sand, double depth, double diameter);

 private:
  double energy_between(double from, double to) const override;

  double limit_ = 0.0;      // A p_u
  double stiffness_ = 0.0;  // k X
};

/// p = p_u / 2 (y / y_c)^(1/3) up to p_u at 8 y_c, y_c = 2.5 epsilon_50 D, with
/// p_u = min(3 c + w X + J c X / D, 9 c) D; a line up to 0.1 y_c. For cyclic loads 0.72 p_u from
/// 3 y_c on, and above the depth X_R = 6 D / (w D / c + J) less: from there along a line to
/// 0.72 p_u X / X_R at 15 y_c. @source Matlock (1970), OTC 1204
class ClayCurve final : public Curve {
 public:
  ClayCurve(const Clay& clay, double depth, double diameter, bool cyclic);
  double force(double y) const override;
  double slope(double y) const override;
  double energy(double y) const override;
  std::vector<double> knots() const override;

  static double ultimate(const Clay& clay, double depth, double diameter);

 private:
  double cubic(double y) const;  // p_u / 2 (y / y_c)^(1/3)

  double ultimate_ = 0.0;
  double yc_ = 0.0;
  double start_ = 0.0;  // end of the line from zero
  double peak_ = 0.0;   // end of the cube root
  double end_ = 0.0;    // end of the line that follows it; where there is none, `peak_`
  double peak_force_ = 0.0;
  double last_force_ = 0.0;
};

/// Fractions of the shaft's resistance in clay, t-z: displacements over the diameter.
struct ShaftTable {
  std::vector<double> displacements;
  std::vector<double> fractions;
};
/// Of clay, displacements over the diameter; the rest after 0.02 D is `residual`.
ShaftTable clay_shaft(double diameter, double residual);
/// Of sand: linear up to 2.54 mm.
ShaftTable sand_shaft();
/// Of the tip, Q-z, sand and clay.
ShaftTable tip(double diameter);

}  // namespace culm::soil
