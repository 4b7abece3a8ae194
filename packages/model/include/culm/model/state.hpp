/// The state of a model at both ends of a step.
#pragma once

#include <culm/model/coordinates.hpp>

#include <vector>

namespace culm::model {

/// Everything that changes while a model is solved. Arrays have a place for every node, but a rank
/// keeps only the nodes that its rows need up to date, and in steps it has no others.
struct State {
  double time_prev = 0.0;  ///< start of the step: time [s], or the load parameter in statics [-]
  double time = 0.0;       ///< end of the step
  Coordinates prev;        ///< accepted configuration at the start of the step
  Coordinates next;        ///< trial configuration at the end of the step
  bool at_rest = true;     ///< nothing has moved in time yet
  bool in_motion = false;  ///< the present analysis makes steps of time, no equilibria
  Coordinates velocity;    ///< at the start of the step [m/s, 1/s]; empty in statics
  /// Acceleration in the equations while q_next = q_prev [m/s^2, 1/s^2]; empty in statics.
  Coordinates acceleration_offset;
  std::vector<double> multipliers_prev;  ///< Lagrange multipliers of the last accepted step
  std::vector<double> multipliers;       ///< trial multipliers, by multiplier index
  std::vector<double> own_prev;          ///< unknowns of batches in the last accepted step
  std::vector<double> own;               ///< trial values, as OwnBlock::first places them
};

}  // namespace culm::model
