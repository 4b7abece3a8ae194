#include <culm/rotor/induction.hpp>

#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>

namespace culm::rotor {
namespace {

using std::numbers::pi;
// the residual is singular at angles of 0 and pi
constexpr double least_angle = 1e-6;
// below this share of the wind a component counts as none
constexpr double no_wind = 1e-6;

// A function of the inflow angle and of an angle that is added to that of attack.
struct Curve {
  double value = 0.0, by_angle = 0.0, by_turn = 0.0;
};

// Value and derivatives of a function of two curves.
Curve chain(double value, double slope, const Curve& x) {
  return {value, slope * x.by_angle, slope * x.by_turn};
}
Curve chain(double value, double slope, const Curve& x, double other_slope, const Curve& y) {
  return {value, slope * x.by_angle + other_slope * y.by_angle,
          slope * x.by_turn + other_slope * y.by_turn};
}

// Loads over momentum at an inflow angle.
struct Balance {
  Curve kappa, kappa_tangential, loss;
};

Balance balance(const BladeElement& element, const Section& section, double angle) {
  const double sine = std::sin(angle);
  const double cosine = std::cos(angle);
  const AnnulusPlace& place = element.place;
  const double solidity = place.blades * element.chord / (2.0 * pi * place.radius);
  const double alpha = angle - element.twist;
  LiftDrag c = section(std::abs(alpha) <= pi ? alpha : std::remainder(alpha, 2.0 * pi));
  if (!element.drag_induces) c.drag = c.drag_slope = 0.0;
  const double normal = c.lift * cosine + c.drag * sine;
  const double tangential = c.lift * sine - c.drag * cosine;
  const double normal_turn = c.lift_slope * cosine + c.drag_slope * sine;
  const double tangential_turn = c.lift_slope * sine - c.drag_slope * cosine;
  double loss_slope;
  const double loss = loss_factor(element.losses, place, angle, loss_slope);
  const double factor = solidity / (4.0 * loss * sine * sine);
  const double factor_tangential = solidity / (4.0 * loss * sine * cosine);
  const double fall = loss_slope / loss + 2.0 * cosine / sine;
  const double fall_tangential = loss_slope / loss + cosine / sine - sine / cosine;
  return {
      {factor * normal, factor * (normal_turn - tangential - fall * normal), factor * normal_turn},
      {factor_tangential * tangential,
       factor_tangential * (tangential_turn + normal - fall_tangential * tangential),
       factor_tangential * tangential_turn},
      {loss, loss_slope, 0.0}};
}

// Of wind against the axis, where momentum is taken by a rotor that drives the air.
Curve propeller_curve(const Curve& kappa) {
  if (kappa.value <= 1.0) return {};
  const double more = kappa.value - 1.0;
  return chain(kappa.value / more, -1.0 / (more * more), kappa);
}

// For phi > 0. Above kappa = 2/3 by Buhl's parabola,
//   H = 4 F kappa (1 - a)^2 - 8/9 - (4 F - 40/9) a - (50/9 - 4 F) a^2 = 0
Curve axial_curve(const Balance& b) {
  const double kappa = b.kappa.value, loss = b.loss.value;
  const double a = axial_induction(kappa, loss);
  if (kappa <= 2.0 / 3.0) return chain(a, 1.0 / ((1.0 + kappa) * (1.0 + kappa)), b.kappa);
  const double left = 1.0 - a;
  const double by_a =
      -8.0 * loss * kappa * left - (4.0 * loss - 40.0 / 9.0) - 2.0 * (50.0 / 9.0 - 4.0 * loss) * a;
  return chain(a, -4.0 * loss * left * left / by_a, b.kappa,
               -4.0 * (kappa * left * left - a * left) / by_a, b.loss);
}

// The balance at an inflow angle, in or out of equilibrium.
struct Point {
  Curve residual, axial, tangential;
  double by_ratio = 0.0;  // of the residual, by axial over tangential wind
};

Point examine(const BladeElement& element, const Section& section, double angle) {
  const double sine = std::sin(angle);
  const double cosine = std::cos(angle);
  const double ratio = element.axial / element.tangential;
  const Balance b = balance(element, section, angle);
  const double rest = 1.0 - b.kappa_tangential.value;
  Point point;
  point.axial = angle > 0.0 ? axial_curve(b) : propeller_curve(b.kappa);
  point.tangential =
      chain(b.kappa_tangential.value / rest, 1.0 / (rest * rest), b.kappa_tangential);
  Curve slowing;
  if (angle < 0.0) {
    slowing = chain(1.0 - b.kappa.value, -1.0, b.kappa);
  } else if (b.kappa.value <= 2.0 / 3.0) {  // 1 / (1 - a) without its pole at kappa = -1
    slowing = chain(1.0 + b.kappa.value, 1.0, b.kappa);
  } else {
    const double left = 1.0 - point.axial.value;
    slowing = chain(1.0 / left, 1.0 / (left * left), point.axial);
  }
  point.residual = chain(sine * slowing.value - ratio * cosine * rest, sine, slowing,
                         ratio * cosine, b.kappa_tangential);
  point.residual.by_angle += cosine * slowing.value + ratio * sine * rest;
  point.by_ratio = -cosine * rest;
  return point;
}

// The induction at an angle close to that of a point.
Induction induction_at(const BladeElement& element, const Point& point, double angle,
                       double change) {
  Induction result{angle + change, point.axial.value + change * point.axial.by_angle,
                   point.tangential.value + change * point.tangential.by_angle};
  const double ratio = element.axial / element.tangential;
  const Eigen::RowVector3d of_residual(point.by_ratio / element.tangential,
                                       -point.by_ratio * ratio / element.tangential,
                                       point.residual.by_turn);
  const Eigen::RowVector3d of_angle = -of_residual / point.residual.by_angle;
  result.slope.row(0) = point.axial.by_angle * of_angle;
  result.slope.row(1) = point.tangential.by_angle * of_angle;
  result.slope.col(2) += Vec<2>(point.axial.by_turn, point.tangential.by_turn);
  if (!result.slope.allFinite()) result.slope.setZero();  // a point where it turns back
  return result;
}

// The residual is blind to a wind that blows the other way.
bool blows_along(const BladeElement& element, const Induction& induction) {
  const double axial = element.axial * (1.0 - induction.axial);
  const double tangential = element.tangential * (1.0 + induction.tangential);
  return axial * std::sin(induction.inflow_angle) + tangential * std::cos(induction.inflow_angle) >
         0.0;
}

// Newton's method from an angle between 0 and pi / 2, unless it leaves them. Its last change is so
// small that functions are linear over it.
std::optional<Induction> find_near(const BladeElement& element, const Section& section,
                                   double angle) {
  constexpr int most = 8;
  constexpr double small = 1e-8;
  for (int i = 0; i < most; ++i) {
    const Point point = examine(element, section, angle);
    const double change = -point.residual.value / point.residual.by_angle;
    if (!(angle + change > least_angle && angle + change < 0.5 * pi)) return {};
    if (std::abs(change) <= small * angle) {
      const Induction found = induction_at(element, point, angle, change);
      if (!blows_along(element, found)) return {};
      return found;
    }
    angle += change;
  }
  return {};
}

template <class Residual>
std::optional<double> root(const Residual& residual, double low, double high) {
  const double at_low = residual(low);
  const double at_high = residual(high);
  if (!std::isfinite(at_low) || !std::isfinite(at_high) || at_low * at_high > 0.0) return {};
  if (at_low == 0.0) return low;
  if (at_high == 0.0) return high;
  std::uintmax_t evaluations = 100;
  const auto [below, above] =
      boost::math::tools::toms748_solve(residual, low, high, at_low, at_high,
                                        boost::math::tools::eps_tolerance<double>(48), evaluations);
  return 0.5 * (below + above);
}

// For wind along the axis.
Induction solve_forward(const BladeElement& element, const Section& section, double near) {
  if (near > 0.0) {
    if (const auto found = find_near(element, section, near)) return *found;
  }
  const auto residual = [&](double angle) { return induction_residual(element, section, angle); };
  const std::pair<double, double> brackets[] = {
      {least_angle, 0.5 * pi}, {-0.25 * pi, -least_angle}, {0.5 * pi, pi - least_angle}};
  for (const auto& [low, high] : brackets) {
    const auto angle = root(residual, low, high);
    if (!angle) continue;
    const Induction induction =
        induction_at(element, examine(element, section, *angle), *angle, 0.0);
    if (blows_along(element, induction)) return induction;
  }
  return {.inflow_angle = std::atan2(element.axial, element.tangential), .found = false};
}

// Wind against the axis is wind along it, seen from behind.
Induction solve_backward(BladeElement element, const Section& section, double near) {
  element.axial = -element.axial;
  element.twist = -element.twist;
  const auto mirrored = [&](double angle) {
    const LiftDrag c = section(-angle);
    return LiftDrag{-c.lift, c.drag, c.lift_slope, -c.drag_slope};
  };
  Induction result = solve_forward(element, mirrored, -near);
  result.inflow_angle = -result.inflow_angle;
  result.slope.col(0) *= -1.0;
  result.slope.col(2) *= -1.0;
  return result;
}

}  // namespace

double axial_induction(double kappa, double loss) {
  if (kappa <= 2.0 / 3.0) return kappa / (1.0 + kappa);
  const double g1 = 2.0 * loss * kappa - (10.0 / 9.0 - loss);
  const double g2 = 2.0 * loss * kappa - loss * (4.0 / 3.0 - loss);
  const double g3 = 2.0 * loss * kappa - (25.0 / 9.0 - 2.0 * loss);
  // numerator and denominator vanish together
  if (std::abs(g3) < 1e-6) return 1.0 - 0.5 / std::sqrt(g2);
  return (g1 - std::sqrt(g2)) / g3;
}

double induction_residual(const BladeElement& element, const Section& section, double angle) {
  return examine(element, section, angle).residual.value;
}

Induction solve_induction(const BladeElement& element, const Section& section, double near) {
  const double wind = std::hypot(element.axial, element.tangential);
  if (std::abs(element.axial) <= no_wind * wind || std::abs(element.tangential) <= no_wind * wind)
    return {.inflow_angle = std::atan2(element.axial, element.tangential), .found = false};
  return element.axial > 0.0 ? solve_forward(element, section, near)
                             : solve_backward(element, section, near);
}

}  // namespace culm::rotor
