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
  Number area;         ///< [m^2]
  Number first;        ///< integral of the height over the centre, in the plane of the circle [m^3]
  double chord = 0.0;  ///< how long the line is within the circle [m]
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
                -2.0 * R * half_width),
          2.0 * half_width};
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

/// Whether a linear function with these values at shares 0 and 1 is zero between them; a zero that
/// two pieces share belongs to one of them, so that its motion counts, and counts once.
template <class Number>
bool changes_sign(const Number& at_start, const Number& at_end) {
  return (value_of(at_start) > 0.0) != (value_of(at_end) > 0.0);
}

/// A run of slices that the surface cuts, as places m + a sin(angle): the square roots that widths
/// of slices have where slices begin to be cut are smooth in the angle.
template <class Number>
struct CutRun {
  Number middle, amplitude;      ///< m and a [shares]
  std::array<Number, 2> angles;  ///< of its ends [rad]

  /// Calls visit(share, weight).
  template <class Visit>
  void visit(Visit visit) const {
    using std::cos;
    using std::sin;
    constexpr int panels = 3;
    const Number half = (angles[1] - angles[0]) * Number(0.5 / panels);
    for (int k = 0; k < panels; ++k) {
      const Number centre = angles[0] + half * Number(2.0 * k + 1.0);
      for (const auto& [xi, weight] : gauss_legendre(6)) {
        const Number angle = centre + half * Number(xi);
        visit(Number(middle + amplitude * sin(angle)),
              Number(amplitude * cos(angle) * half * Number(weight)));
      }
    }
  }
};

/// The slices between two shares, all cut. @param full, dry  where slices begin to be cut: linear
/// functions by their values at shares 0 and 1
template <class Number>
CutRun<Number> cut_run(const Number& from, const Number& to, const std::array<Number, 2>& full,
                       const std::array<Number, 2>& dry) {
  constexpr double right_angle = 0.5 * std::numbers::pi;
  constexpr double longest = 1e3;  // beyond, slices hardly differ, and places would lose digits
  const auto slope = [](const std::array<Number, 2>& f) { return value_of(f[1]) - value_of(f[0]); };
  const auto root = [](const std::array<Number, 2>& f) {
    return value_of(f[0]) / (value_of(f[0]) - value_of(f[1]));
  };
  const bool has_roots = slope(full) != 0.0 && slope(dry) != 0.0;
  const double low = has_roots ? std::min(root(full), root(dry)) : 0.0;
  const double high = has_roots ? std::max(root(full), root(dry)) : 0.0;
  constexpr double rounding = 1e-12;
  if (!has_roots || high - low > longest || value_of(from) < low - rounding ||
      value_of(to) > high + rounding) {
    return {Number(0.5) * (from + to),
            Number(0.5) * (to - from),
            {Number(-right_angle), Number(right_angle)}};
  }
  const Number r0 = full[0] / (full[0] - full[1]), r1 = dry[0] / (dry[0] - dry[1]);
  const bool rises = value_of(r1) > value_of(r0);
  CutRun<Number> run;
  run.middle = Number(0.5) * (r0 + r1);
  run.amplitude = Number(rises ? 0.5 : -0.5) * (r1 - r0);
  const auto angle_of = [&](const Number& share) {
    const Number sine = (share - run.middle) / run.amplitude;
    const double s = value_of(sine), square = 1.0 - s * s;
    // an end where slices begin to be cut
    if (square <= rounding) return Number(s > 0.0 ? right_angle : -right_angle);
    return chain(std::asin(s), sine, 1.0 / std::sqrt(square), sine, 0.0);
  };
  run.angles = {angle_of(from), angle_of(to)};
  return run;
}

/// Calls visit(share, weight, slice) for points of a quadrature over the wet slices; weights are in
/// shares of the axis. Exact for cubic functions of the share where slices are wet as a whole, and
/// to about 1e-12 where the surface cuts them.
template <class Number, class Visit>
void visit_wet(const Cone& cone, const Immersion<Number>& immersion, Visit visit) {
  const auto& [h0, h1] = immersion.depths;
  const Number reach0 = Number(cone.radii[0]) * immersion.sine;
  const Number reach1 = Number(cone.radii[1]) * immersion.sine;
  // rounding must not decide in which of two pieces the surface stands
  constexpr double rounding = 1e-12;
  const double nothing = rounding * (std::abs(value_of(h0)) + std::abs(value_of(h1)) +
                                     value_of(reach0) + value_of(reach1));
  const auto snapped = [nothing](const Number& depth) {
    return std::abs(value_of(depth)) > nothing ? depth : Number(depth - value_of(depth));
  };
  // positive where slices are wet as a whole, and where they are not dry
  const std::array<Number, 2> full = {snapped(Number(h0 - reach0)), snapped(Number(h1 - reach1))};
  const std::array<Number, 2> dry = {snapped(Number(h0 + reach0)), snapped(Number(h1 + reach1))};
  std::array<Number, 4> ends = {Number(0.0), Number(0.0), Number(0.0), Number(1.0)};
  if (changes_sign(full[0], full[1])) ends[1] = full[0] / (full[0] - full[1]);
  if (changes_sign(dry[0], dry[1])) ends[2] = dry[0] / (dry[0] - dry[1]);
  if (value_of(ends[1]) > value_of(ends[2])) std::swap(ends[1], ends[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Number &from = ends[i], &to = ends[i + 1];
    if (value_of(to) - value_of(from) < 0.1 * rounding) continue;
    const double share = 0.5 * (value_of(from) + value_of(to));
    if (std::lerp(value_of(dry[0]), value_of(dry[1]), share) <= 0.0) continue;
    if (std::lerp(value_of(full[0]), value_of(full[1]), share) < 0.0) {
      cut_run<Number>(from, to, full, dry).visit([&](const Number& at, const Number& weight) {
        visit(at, weight, slice_at<Number>(cone, immersion, at));
      });
      continue;
    }
    const Number middle = Number(0.5) * (from + to), half = Number(0.5) * (to - from);
    for (const auto& [xi, weight] : gauss_legendre(2)) {
      const Number at = middle + half * Number(xi);
      visit(at, Number(half * Number(weight)), whole_slice<Number>(cone.radius(at)));
    }
  }
}

}  // namespace culm::water
