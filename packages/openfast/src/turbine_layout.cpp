#include "turbine_layout.hpp"

#include <culm/math/quadrature.hpp>
#include <culm/math/rotation.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace culm::openfast {

TurbineLayout::TurbineLayout(const ElastoDyn& turbine)
    : base(0.0, 0.0, turbine.tower_base),
      top(0.0, 0.0, turbine.tower_top),
      nacelle(exp_rotation(turbine.yaw_angle() * Vec3::UnitZ())),
      shaft(nacelle * Vec3(std::cos(turbine.tilt), 0.0, std::sin(turbine.tilt))),
      place(top + Vec3(0.0, 0.0, turbine.shaft_height)),
      apex(place + turbine.overhang * shaft) {
  const Vec3 side = nacelle.col(1);
  const Mat3 upright = (Mat3() << shaft, side, shaft.cross(side)).finished();
  for (std::size_t i = 0; i < turbine.cones.size(); ++i) {
    const double step = 2.0 * std::numbers::pi / static_cast<double>(turbine.cones.size());
    const double azimuth = turbine.azimuth + static_cast<double>(i) * step;
    // azimuth about the shaft, then the cone about y, then the pitch about -z
    const Mat3 axes = exp_rotation(azimuth * shaft) * upright *
                      exp_rotation(turbine.cones[i] * Vec3::UnitY()) *
                      exp_rotation(-turbine.pitches[i] * Vec3::UnitZ());
    roots.push_back({apex + turbine.hub_radius * axes.col(2), axes});
  }
}

double yaw_inertia(const ElastoDyn& turbine, const TurbineLayout& layout) {
  double sum = turbine.nacelle_inertia + turbine.hub_mass * layout.apex.head<2>().squaredNorm();
  for (std::size_t i = 0; i < turbine.blades.size(); ++i) {
    const BeamDyn& beam = turbine.blades[i].beam;
    const BladeAxis axis(beam.key_points);
    const Placement& root = layout.roots[i];
    const auto& stations = beam.blade.stations;
    for (std::size_t k = 0; k + 1 < stations.size(); ++k) {
      for (const QuadraturePoint& point : gauss_legendre(4)) {
        const double t = 0.5 * (1.0 + point.xi);
        const double span = (1.0 - t) * stations[k].span + t * stations[k + 1].span;
        const double m = (1.0 - t) * stations[k].mass(0, 0) + t * stations[k + 1].mass(0, 0);
        const double length =
            0.5 * point.weight * (stations[k + 1].span - stations[k].span) * axis.curve.length();
        const Vec3 x = root.root + root.axes * axis.curve.position(span * axis.curve.length());
        sum += length * m * x.head<2>().squaredNorm();
      }
    }
    const Vec3 tip = root.root + root.axes * beam.key_points.back().position;
    sum += turbine.tip_masses[i] * tip.head<2>().squaredNorm();
  }
  return sum;
}

}  // namespace culm::openfast
