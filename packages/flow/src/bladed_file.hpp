/// Boxes of turbulence of Bladed (.wnd).
#pragma once

#include "turbulence_grid.hpp"

#include <array>
#include <optional>
#include <string>

namespace culm::flow {

/// What such a file does not say of itself, or says otherwise.
struct BladedScaling {
  std::optional<double> speed = {};  ///< with which planes move; that of the file if absent [m/s]
  std::optional<std::array<double, 3>> intensities = {};  ///< of the three components [1]
  bool contains_mean = true;    ///< values count from the mean speed, which is added
  bool is_left_handed = true;   ///< components across point to the right, seen along the wind
  bool begins_at_left = false;  ///< points across stand from the left to the right
  bool is_periodic = true;
};

/// Reads a file that begins with -99, which Bladed writes since version 3.5, and TurbSim: planes of
/// integers n, component fastest, then across, then upwards, with
///   u = speed (1 + I n / 1000), v and w = speed I n / 1000.
/// Throws InputError with the path and what is wrong.
/// @param name   relative to the folder of the deck, or absolute
/// @param where  the place of the name in the deck
/// @source user documentation of TurbSim and InflowWind
TurbulenceGrid read_bladed(const std::string& name, const Where& where,
                           const BladedScaling& scaling);

}  // namespace culm::flow
