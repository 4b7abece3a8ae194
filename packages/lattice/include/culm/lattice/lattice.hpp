/// The flow about lifting surfaces by vortex rings, steady and step by step.
#pragma once

#include <culm/flow/flow.hpp>
#include <culm/lattice/bound_lattice.hpp>
#include <culm/lattice/wake.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <optional>
#include <span>
#include <vector>

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

/// One row of a straight wake behind one strip, in small motions about a steady flow.
struct WakeRow {
  Eigen::Index edge_ring = 0;  ///< whose circulation it carries
  double delay = 0.0;          ///< time after which it does [s]
  Eigen::VectorXd induced;     ///< along the normals at collocation points, per circulation [1/m]
};

/// Linearisation about a steady flow, by motions x of the grid that are given as columns. With the
/// influence A of the bound rings and what rows of the wake of these delays induce,
///   A G + sum of rows = flow_by_place x + flow_by_velocity x'
///   f = by_circulation G + by_growth G' + by_place x + by_velocity x'
/// where f are forces along the same motions: what each does work with, per unit of it.
struct SmallMotions {
  double passing = 0.0;  ///< mean time in which the wind passes half a chord; 0 without wind [s]
  double panel = 0.0;    ///< longest time in which it passes a panel [s]
  Eigen::MatrixXd influence;
  std::vector<WakeRow> rows;
  Eigen::MatrixXd flow_by_place, flow_by_velocity;
  Eigen::MatrixXd by_circulation, by_growth, by_place, by_velocity;
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
  const LatticeSetting& setting() const { return setting_; }
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
  /// Small motions about a steady flow, whose wake is straight along it: rows of one panel first,
  /// then longer ones the farther they are, to the end of that of the steady flow. What rings that
  /// move induce is left out as in `change_of_forces`.
  /// @param motions  of the grid by column, three components for each of its points
  SmallMotions small_motions(const FluidResult& steady, const Points& grid, double time,
                             const Eigen::MatrixXd& motions) const;
  /// The state at the end of a step.
  static FluidState state_after(const FluidResult& result, Wake wake);

  /// A flow that has always been as it is, with one row of wake that is straight along it.
  FluidResult steady(const Points& grid, double time) const;
  /// The state after it.
  FluidState steady_state(const FluidResult& result, const Points& grid, double time) const;

 private:
  Points flow_at(const Points& places, double time) const;
  Points force_points(const Points& grid) const;
  Points unit_normals(const Points& grid) const;  ///< of the panels
  /// How much of a motion is small for differences; 0 if it is none.
  double small_way(const Points& change) const;
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
  /// Change of the unit normals of the panels by a motion.
  Points change_of_normals(const Points& grid, const Points& change) const;
  /// Adds to a column what a row of wake between two lines behind one strip induces, per
  /// circulation.
  void add_row(const Points& from, const Points& to, std::size_t strip, const Points& places,
               const Points& normals, std::span<double> column) const;
  void add_straight_rows(const Points& grid, double time, SmallMotions& small) const;
  Points far_line(const Points& edges, double time) const;

  BoundLattice bound_;
  flow::SharedFlow flow_;
  LatticeSetting setting_;
};

}  // namespace culm::lattice
