/// What goes over an interface in a stretch of time.
#pragma once

#include <culm/port/port.hpp>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace culm::coupling {

/// Quantities of a port, as a set of bits.
using Quantities = unsigned;
constexpr Quantities bit(port::Quantity quantity) { return 1U << static_cast<unsigned>(quantity); }
constexpr std::array all_quantities = {port::Quantity::position, port::Quantity::rotation,
                                       port::Quantity::velocity, port::Quantity::acceleration,
                                       port::Quantity::motion};

/// Numbers per point of a set of quantities.
constexpr int components(Quantities wanted) {
  int count = 0;
  for (const port::Quantity q : all_quantities) {
    if ((wanted & bit(q)) != 0) count += port::components(q);
  }
  return count;
}

/// A step that the structure made within a window.
struct WindowStep {
  double start = 0.0;
  double end = 0.0;            ///< [s]
  std::vector<double> motion;  ///< as port::Quantity::motion
};

/// A window of time, from one exchange that counts to the next, and how the points of a port move
/// in it: position, rotation and velocity at its end, motion over all of it, acceleration of its
/// last step.
struct Window {
  int number = 0;   ///< from 0
  int attempt = 0;  ///< from 0, in this window
  double start = 0.0;
  double end = 0.0;                           ///< [s]
  std::array<std::vector<double>, 5> motion;  ///< by port::Quantity; empty what nobody wants
  std::vector<double> loads;  ///< that acted in it, mean force and moment of each point [N, N m]
  std::vector<WindowStep> steps;  ///< of the structure, where it makes several

  double length() const { return end - start; }
  std::vector<double>& of(port::Quantity q) { return motion[static_cast<std::size_t>(q)]; }
  const std::vector<double>& of(port::Quantity q) const {
    return motion[static_cast<std::size_t>(q)];
  }
};

/// How a coupling begins.
struct Beginning {
  std::string port;
  double time = 0.0;              ///< [s]
  std::vector<double> reference;  ///< positions in the reference, 3 numbers per point [m]
  std::vector<double> velocity;   ///< and angular velocity at this time, 6 numbers [m/s, rad/s]
  int window = 0;                 ///< windows that were accepted before; above 0: a run goes on

  int points() const { return static_cast<int>(reference.size() / 3); }
};

/// What a partner says of its own energy [J]; no numbers where it does not know.
struct Books {
  double energy = 0.0;      ///< that it holds more than at the start
  double dissipated = 0.0;  ///< that it has turned into heat

  bool are_kept() const { return !std::isnan(energy); }
};

}  // namespace culm::coupling
