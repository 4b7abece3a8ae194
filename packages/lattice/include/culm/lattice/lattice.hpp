/// The flow about lifting surfaces by vortex rings, steady and step by step.
#pragma once

#include <culm/flow/flow.hpp>
#include <culm/lattice/bound_lattice.hpp>
#include <culm/lattice/wake.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <optional>
#include <span>

namespace culm::lattice {

/// How forces follow from circulations.
enum class ForceRule {
  joukowski,  ///< on each bound segment, with suction at the leading edge and induced drag
  bernoulli,  ///< pressure jumps, normal to the panels: no suction
};

/// How a wake moves.
enum class WakeMotion {
  prescribed,  ///< with the undisturbed flow
  free,        ///< with all that is induced as well
};

struct LatticeSetting {
  ForceRule forces = ForceRule::joukowski;
  WakeMotion wake = WakeMotion::prescribed;
  int rows = 200;  ///< of the wake, at most
  WakeCore core = {};
};

/// What is known at the end of a step, and all that the next one needs of the past.
struct FluidState {
  Eigen::VectorXd circulation;  ///< by ring [m^2/s]
  Points induced;               ///< velocities where forces act [m/s]
  Wake wake;
};

/// Grid points of all surfaces in a step.
struct GridStep {
  Points start, end;    ///< [m]
  Points end_velocity;  ///< [m/s]
  double time_start = 0.0, time_end = 0.0;
};

/// What the flow does to the surfaces.
struct FluidResult {
  Eigen::VectorXd circulation;  ///< at the end of the step
  Points induced;               ///< at the end of the step
  Points forces;                ///< at grid points; of a step in its middle [N]

  // where it was found, for `Lattice::change_of_forces`
  Eigen::PartialPivLU<Eigen::MatrixXd> influence;  ///< of the circulations
  Points at_collocation;  ///< what moves there relative to them, without the bound rings [m/s]
  Points at_forces;       ///< what moves relative to where forces act [m/s]
};

/// Rings on surfaces with wakes. A step has the wake move and take a row with the circulation of
/// the step before, solves for no flow through the collocation points at its end, and takes forces
/// in its middle, with the mean circulation and the rate of its change. Nothing here keeps
/// anything: results are functions of the state at the start of the step and of the motion in it.
/// @source Katz, Plotkin, Low-Speed Aerodynamics, 12.3, 13.12
class Lattice {
 public:
  Lattice(BoundLattice bound, flow::SharedFlow flow, LatticeSetting setting)
      : bound_(std::move(bound)), flow_(std::move(flow)), setting_(setting) {}

  const BoundLattice& bound() const { return bound_; }
  const flow::Flow& flow() const { return *flow_; }
  /// At rest, without circulation and wake.
  FluidState initial_state() const;

  /// The wake of the coming step, and what its far part induces.
  struct ComingWake {
    Wake wake;
    Points at_collocation, at_forces;
  };
  /// @param expected  grid points at the end of the step, where the far part of the wake is felt
  ComingWake begin_step(const FluidState& state, const Points& start, const Points& expected,
                        double time_start, double time_end) const;
  FluidResult step(const FluidState& state, const ComingWake& coming, const GridStep& grid) const;
  /// Derivative of the forces at grid points by a motion `change` of the grid at the end of a step,
  /// times that motion: of the boundary condition, of the circulation with all rings, and of what
  /// carries the forces. What is induced at rings that move stays as it is, which is without error
  /// for flat surfaces in the wind.
  /// @param before  circulation at the start of the step; of no meaning if that has no duration
  /// @param grid    of the result; in a steady flow both ends are the same
  Points change_of_forces(const FluidResult& result, const Eigen::VectorXd& before,
                          const GridStep& grid, const Points& change) const;
  /// The state at the end of a step.
  static FluidState state_after(const FluidResult& result, Wake wake);

  /// A flow that has always been as it is, with one row of wake that is straight along it.
  FluidResult steady(const Points& grid, double time) const;
  /// The state after it.
  FluidState steady_state(const FluidResult& result, const Points& grid, double time) const;

 private:
  Points flow_at(const Points& places, double time) const;
  Points force_points(const Points& grid) const;
  /// Sets circulation and influence of a result from what moves at its collocation points.
  void solve(const Segments& segments, const Points& grid, const Wake* straight,
             const Points& edges, FluidResult& result) const;
  Points induced_at(const Points& places, const Segments& segments,
                    const Eigen::VectorXd& circulation, const Wake& wake,
                    const Points& edges) const;
  Points forces(const Points& grid, const Points& relative, const Eigen::VectorXd& circulation,
                const Eigen::VectorXd& rate) const;
  void add_joukowski(const Points& grid, const Points& relative, const Eigen::VectorXd& circulation,
                     Points& forces) const;
  void add_bernoulli(const Points& grid, const Points& relative, const Eigen::VectorXd& circulation,
                     Points& forces) const;
  Points far_line(const Points& edges, double time) const;

  BoundLattice bound_;
  flow::SharedFlow flow_;
  LatticeSetting setting_;
};

}  // namespace culm::lattice
