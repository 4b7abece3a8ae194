/// How the coordinates of links follow from their forms, with derivatives that keep energy.
#pragma once

#include <culm/load/link.hpp>
#include <culm/math/types.hpp>

namespace culm::load {

/// Lengths are not taken below this one [m], so that a spring of no length has the stiffness
/// lim F(z) / z. Its square still is a normal number.
constexpr double no_length = 1e-100;

/// A step of a coordinate z from the forms a to the forms b.
struct MeasureStep {
  double next = 0.0;                         ///< z at the end
  Vec<2> slope = Vec<2>::Zero();             ///< dz/dy at the end
  Vec<2> gradient = Vec<2>::Zero();          ///< G, dz/dy where a = b
  Mat<2, 2> derivative = Mat<2, 2>::Zero();  ///< of G by the forms at the end
};

/// z at forms y that a motion of less than half a turn leads to from forms y_prev with z_prev.
double measure(Measure measure, const Vec<2>& y_prev, double z_prev, const Vec<2>& y);

/// G . Dy = Dz at theta = 1/2; dz/dy of the end at theta = 1.
/// @source formulation 1.3.5, eq. (1.12); 3.6
MeasureStep measure_step(Measure measure, const Vec<2>& y_prev, double z_prev, const Vec<2>& y_next,
                         double theta);

}  // namespace culm::load
