/// Flat wings in a uniform flow along x, for tests.
#pragma once

#include <culm/lattice/lattice.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace culm::lattice::kit {

class Wind final : public flow::Flow {
 public:
  explicit Wind(Vec3 velocity, double density = 1.0)
      : Flow(density), velocity_(std::move(velocity)) {}
  void velocities(std::span<const Vec3>, double, std::span<Vec3> out) const override {
    std::fill(out.begin(), out.end(), velocity_);
  }

 private:
  Vec3 velocity_;
};

/// Half a wing from the plane y = 0: chord by y, leading edge by y.
struct Wing {
  double half_span = 1.0;
  double chord = 1.0;
  double sweep = 0.0;  ///< of the leading edge [rad]
  bool inset = true;
  bool elliptical = false;
};

inline Points grid(const Wing& wing, Panels panels) {
  const double width =
      wing.half_span / (wing.inset ? panels.span + 0.25 : static_cast<double>(panels.span));
  Points points;
  for (int i = 0; i <= panels.chord; ++i) {
    for (int j = 0; j <= panels.span; ++j) {
      const double y = width * j;
      double chord = wing.chord, front = y * std::tan(wing.sweep);
      if (wing.elliptical) {
        const double eta = std::min(y / wing.half_span, 1.0);
        chord *= std::sqrt(std::max(1.0 - eta * eta, 1e-8));
        front = 0.25 * (wing.chord - chord);
      }
      points.push_back({front + chord * i / panels.chord, y, 0.0});
    }
  }
  return points;
}

inline Vec3 total(const Points& forces) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < forces.size(); ++i) sum += forces.at(i);
  return sum;
}

inline Lattice make(const Wing& wing, Panels panels, double alpha, LatticeSetting setting = {}) {
  return Lattice(BoundLattice({panels}, grid(wing, panels), Vec3(0.0, 1.0, 0.0)),
                 std::make_shared<Wind>(Vec3(std::cos(alpha), 0.0, std::sin(alpha))), setting);
}

/// Lift over dynamic pressure, area of the half wing and, of the steady wing, alpha.
inline double lift_slope(const Wing& wing, Panels panels, LatticeSetting setting = {}) {
  const double alpha = 1e-3;
  const Vec3 force =
      total(make(wing, panels, alpha, setting).steady(grid(wing, panels), 0.0).forces);
  const double area = wing.chord * wing.half_span * (wing.elliptical ? std::atan(1.0) : 1.0);
  return (force.z() * std::cos(alpha) - force.x() * std::sin(alpha)) / (0.5 * area * alpha);
}

}  // namespace culm::lattice::kit
