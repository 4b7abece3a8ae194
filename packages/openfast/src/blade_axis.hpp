/// The reference axis of a blade as culm describes it.
#pragma once

#include <culm/math/spline.hpp>
#include <culm/openfast/beamdyn.hpp>

#include <vector>

namespace culm::openfast {

/// The axis through the key points, in the frame of the blade root, and how sections stand on it.
struct BladeAxis {
  Spline curve;
  bool straight = true;
  std::vector<double> spans;   ///< of the key points, arc length over the whole length
  std::vector<double> angles;  ///< there: of d1 from where Up = x puts it, about the axis [rad]

  explicit BladeAxis(const std::vector<KeyPoint>& key_points);
};

/// Mass, its centre and its moments about the root.
struct BladeMass {
  double mass = 0.0;          ///< [kg]
  Vec3 first = Vec3::Zero();  ///< int m x [kg m]
  double second = 0.0;        ///< int m z^2 [kg m^2]
};

/// Integrals of sections that vary linearly between stations, exact for a straight axis.
BladeMass integrate_mass(const BladeAxis& axis, const std::vector<BladeStation>& stations);

}  // namespace culm::openfast
