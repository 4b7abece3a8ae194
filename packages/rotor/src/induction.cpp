#include <culm/rotor/induction.hpp>

#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>

namespace culm::rotor {
namespace {

constexpr double pi = std::numbers::pi;
// the residual is singular at angles of 0 and pi
constexpr double least_angle = 1e-6;
// below this share of the wind a component counts as none
constexpr double no_wind = 1e-6;

// Loads over momentum at an inflow angle.
struct Balance {
  double kappa, kappa_tangential, loss;
};

Balance balance(const BladeElement& element, const Section& section, double angle) {
  const double sine = std::sin(angle);
  const double cosine = std::cos(angle);
  const AnnulusPlace& place = element.place;
  const double solidity = place.blades * element.chord / (2.0 * pi * place.radius);
  LiftDrag c = section(std::remainder(angle - element.twist, 2.0 * pi));
  if (!element.drag_induces) c.drag = 0.0;
  const double normal = c.lift * cosine + c.drag * sine;
  const double tangential = c.lift * sine - c.drag * cosine;
  const double loss = loss_factor(element.losses, place, angle);
  return {solidity * normal / (4.0 * loss * sine * sine),
          solidity * tangential / (4.0 * loss * sine * cosine), loss};
}

// Of wind against the axis, where momentum is taken by a rotor that drives the air.
double propeller_induction(double kappa) { return kappa > 1.0 ? kappa / (kappa - 1.0) : 0.0; }

Induction induction_at(const BladeElement& element, const Section& section, double angle) {
  const Balance b = balance(element, section, angle);
  return {angle, angle > 0.0 ? axial_induction(b.kappa, b.loss) : propeller_induction(b.kappa),
          b.kappa_tangential / (1.0 - b.kappa_tangential)};
}

// The residual is blind to a wind that blows the other way.
bool blows_along(const BladeElement& element, const Induction& induction) {
  const double axial = element.axial * (1.0 - induction.axial);
  const double tangential = element.tangential * (1.0 + induction.tangential);
  return axial * std::sin(induction.inflow_angle) + tangential * std::cos(induction.inflow_angle) >
         0.0;
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
Induction solve_forward(const BladeElement& element, const Section& section) {
  const auto residual = [&](double angle) { return induction_residual(element, section, angle); };
  const std::pair<double, double> brackets[] = {
      {least_angle, 0.5 * pi}, {-0.25 * pi, -least_angle}, {0.5 * pi, pi - least_angle}};
  for (const auto& [low, high] : brackets) {
    const auto angle = root(residual, low, high);
    if (!angle) continue;
    const Induction induction = induction_at(element, section, *angle);
    if (blows_along(element, induction)) return induction;
  }
  return {.inflow_angle = std::atan2(element.axial, element.tangential), .found = false};
}

// Wind against the axis is wind along it, seen from behind.
Induction solve_backward(BladeElement element, const Section& section) {
  element.axial = -element.axial;
  element.twist = -element.twist;
  const auto mirrored = [&](double angle) {
    const LiftDrag c = section(-angle);
    return LiftDrag{-c.lift, c.drag};
  };
  Induction result = solve_forward(element, mirrored);
  result.inflow_angle = -result.inflow_angle;
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
  const Balance b = balance(element, section, angle);
  const double tangential =
      element.axial / element.tangential * std::cos(angle) * (1.0 - b.kappa_tangential);
  if (angle < 0.0) return std::sin(angle) * (1.0 - b.kappa) - tangential;
  // 1 / (1 - a) without its pole at kappa = -1
  const double slowing =
      b.kappa <= 2.0 / 3.0 ? 1.0 + b.kappa : 1.0 / (1.0 - axial_induction(b.kappa, b.loss));
  return std::sin(angle) * slowing - tangential;
}

Induction solve_induction(const BladeElement& element, const Section& section) {
  const double wind = std::hypot(element.axial, element.tangential);
  if (std::abs(element.axial) <= no_wind * wind || std::abs(element.tangential) <= no_wind * wind)
    return {.inflow_angle = std::atan2(element.axial, element.tangential)};
  return element.axial > 0.0 ? solve_forward(element, section) : solve_backward(element, section);
}

}  // namespace culm::rotor
