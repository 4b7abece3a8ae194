/// Circular frequencies from mode shapes that a file states.
#pragma once

#include <culm/openfast/elastodyn.hpp>

#include <functional>

namespace culm::openfast {

/// A cantilever by its mass per length [kg/m] and bending stiffness [N m^2] along x from 0 to 1.
struct Cantilever {
  double length = 0.0;         ///< [m]
  std::vector<double> places;  ///< where the functions may kink, from 0 to 1
  std::function<double(double)> mass;
  std::function<double(double)> stiffness;
  double tip_mass = 0.0;  ///< [kg]
};

/// Rayleigh's quotient, an upper bound of the lowest circular frequency [rad/s]:
/// omega^2 = int EI phi''^2 / (int m phi^2 + M phi(1)^2). Weight and rotation are not in it.
double rayleigh(const Cantilever& beam, const FileMode& mode);

}  // namespace culm::openfast
