/// Steps of a simulation together with a partner in the same process.
#pragma once

#include <culm/coupling/partner.hpp>
#include <culm/coupling/scheme.hpp>
#include <culm/simulation/simulation.hpp>

#include <string>

namespace culm::simulation {

/// When a window of an implicit scheme is good enough.
struct CouplingSettings {
  double tolerance = 1e-8;  ///< of the residual over the size of the forces
  int most = 100;           ///< attempts per window
};

/// What went over the interface.
struct CouplingReport {
  int windows = 0;
  int attempts = 0;
  int most_attempts = 0;    ///< in a window
  double work = 0.0;        ///< that the structure got [J]
  double energy = 0.0;      ///< that the partner holds more than at the start [J]
  double dissipated = 0.0;  ///< by the partner [J]
  double exchanged = 0.0;   ///< sum of the sizes of all works [J]

  /// What got lost or came from nowhere [J].
  double gap() const { return work + energy + dissipated; }
};

/// Makes all steps of an analysis that moves in time, a window each, with forces of a partner at
/// all points of a port. Collective. Throws UsageError for statics, and NumericalError where a
/// window does not fit or the structure does not converge.
/// @param stepper  of begin()
CouplingReport couple(Simulation& simulation, analysis::Stepper& stepper, const std::string& port,
                      coupling::Partner& partner, coupling::Scheme& scheme,
                      const CouplingSettings& settings = {});

}  // namespace culm::simulation
