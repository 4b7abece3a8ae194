/// How a cone stands in water: which slices across its axis are wet, and how much of them.
#pragma once

#include <culm/math/quadrature.hpp>

#include "carried_number.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace culm::water {

/// A piece of a cone whose axis runs from share 0 to share 1.
struct Cone {
  std::array<double, 2> radii;  ///< at both ends [m]

  template <class Number>
  Number radius(const Number& share) const {
    return between(radii[0], radii[1], share);
  }
};

/// Depth of the axis of a cone under the surface at both ends, and the sine of its tilt against the
/// normal of the surface; 0 stands for a cone so upright that its slices are wet or dry as a whole.
template <class Number>
struct Immersion {
  std::array<Number, 2> depths;  ///< [m]
  Number sine;
};

/// The wet part of a circle, below the line that is `p` above its centre.
template <class Number>
struct WetSlice {
  Number area;   ///< [m^2]
  Number first;  ///< integral of the height over the centre, in the plane of the circle [m^3]
};

template <class Number>
WetSlice<Number> whole_slice(const Number& radius) {
  return {Number(std::numbers::pi) * radius * radius, Number(0.0)};
}

/// @pre |p| <= radius  @source fluids B7
template <class Number>
WetSlice<Number> cut_slice(const Number& p, const Number& radius) {
  const double P = value_of(p), R = value_of(radius);
  const double half_width = std::sqrt(std::max(R * R - P * P, 0.0));
  const double angle = std::acos(std::clamp(-P / R, -1.0, 1.0));
  return {chain(R * R * angle + P * half_width, p, 2.0 * half_width, radius, 2.0 * R * angle),
          chain(-2.0 / 3.0 * half_width * half_width * half_width, p, 2.0 * P * half_width, radius,
                -2.0 * R * half_width)};
}

/// Integral over the wet part of a circle of the square of the height over its centre [m^4].
inline double wet_second_moment(double p, double radius) {
  const double q = std::clamp(p / radius, -1.0, 1.0);
  const double half_width = radius * std::sqrt(1.0 - q * q);
  const double height = q * radius, square = radius * radius;
  return -0.5 * height * std::pow(half_width, 3) +
         0.25 * square * (height * half_width + square * (std::asin(q) + 0.5 * std::numbers::pi));
}

/// The slice of a cone at a share of its axis; nothing where it is dry.
template <class Number>
WetSlice<Number> slice_at(const Cone& cone, const Immersion<Number>& immersion,
                          const Number& share) {
  const Number radius = cone.radius(share);
  const Number depth = immersion.depths[0] + share * (immersion.depths[1] - immersion.depths[0]);
  const double reach = value_of(radius) * value_of(immersion.sine);
  if (value_of(depth) <= -reach) return {Number(0.0), Number(0.0)};
  if (value_of(depth) >= reach) return whole_slice(radius);
  return cut_slice<Number>(Number(depth / immersion.sine), radius);
}

/// Where a linear function with these values at shares 0 and 1 is zero; 0 if it is nowhere.
template <class Number>
Number root(const Number& at_start, const Number& at_end) {
  if (value_of(at_start) * value_of(at_end) >= 0.0) return Number(0.0);
  return at_start / (at_start - at_end);
}

/// Calls visit(share, weight, slice) for points of a quadrature over the wet slices; weights are in
/// shares of the axis. Exact for cubic functions of the share where slices are wet as a whole;
/// where the surface cuts them, to about 1e-10.
template <class Number, class Visit>
void visit_wet(const Cone& cone, const Immersion<Number>& immersion, Visit visit) {
  const auto& [h0, h1] = immersion.depths;
  const Number reach0 = Number(cone.radii[0]) * immersion.sine;
  const Number reach1 = Number(cone.radii[1]) * immersion.sine;
  std::array<Number, 4> ends = {Number(0.0), root<Number>(h0 - reach0, h1 - reach1),
                                root<Number>(h0 + reach0, h1 + reach1), Number(1.0)};
  if (value_of(ends[1]) > value_of(ends[2])) std::swap(ends[1], ends[2]);
  constexpr double nothing = 1e-14;
  for (std::size_t i = 0; i < 3; ++i) {
    const Number &from = ends[i], &to = ends[i + 1];
    if (value_of(to) - value_of(from) < nothing) continue;
    const Number middle = Number(0.5) * (from + to), half = Number(0.5) * (to - from);
    const double share = value_of(middle);
    const double depth = std::lerp(value_of(h0), value_of(h1), share);
    const double reach = cone.radius(share) * value_of(immersion.sine);
    if (depth <= -reach) continue;
    if (depth >= reach) {
      for (const auto& [xi, weight] : gauss_legendre(2)) {
        const Number at = middle + half * Number(xi);
        visit(at, Number(half * Number(weight)), whole_slice<Number>(cone.radius(at)));
      }
      continue;
    }
    // sines of an angle as places, so that square roots at both ends are smooth in the angle
    constexpr int panels = 3;
    constexpr double panel = std::numbers::pi / panels;
    for (int k = 0; k < panels; ++k) {
      for (const auto& [xi, weight] : gauss_legendre(6)) {
        const double angle = panel * (k + 0.5 * (1.0 + xi)) - 0.5 * std::numbers::pi;
        const Number at = middle + half * Number(std::sin(angle));
        visit(at, Number(half * Number(0.5 * panel * weight * std::cos(angle))),
              slice_at<Number>(cone, immersion, at));
      }
    }
  }
}

}  // namespace culm::water
