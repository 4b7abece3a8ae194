/// Forces of a vortex lattice on the structures that carry it.
#pragma once

#include <culm/base/issue.hpp>
#include <culm/flow/fluid_force.hpp>
#include <culm/lattice/harmonic_air.hpp>
#include <culm/lattice/lattice.hpp>
#include <culm/model/delayed.hpp>
#include <culm/model/memoryless_batch.hpp>
#include <culm/model/method_limits.hpp>
#include <culm/model/structure.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm::lattice {

/// The grid of a surface on a structure, points as Panelling numbers them.
struct SurfaceGrid {
  Panels panels;
  std::vector<model::Marker> points;
};

/// What the tangent knows of the forces of a lattice.
enum class LatticeTangent {
  apparent_mass,  ///< half of that of strips, at each point of the grid
  /// `Lattice::change_of_forces` between all nodes that carry the grid, and in linearisations
  /// `LaggedAir`
  whole,
};

/// A lattice whose grid points are material points of structures. Statics take the steady flow,
/// dynamics one step of the unsteady one per time step. Each evaluation solves the lattice for the
/// trial motion; what was accepted changes in `accept` alone. Every rank computes all of it. The
/// whole tangent is found once per attempt of a step in time, and in each iteration of statics; a
/// linearisation has damping, mass and lags about the steady flow as well.
class LatticeLoad final : public model::MemorylessBatch,
                          public model::Delayed,
                          public model::LimitedRange,
                          public model::LeftOutOfModes,
                          public flow::FluidForce {
 public:
  LatticeLoad(model::Effect effect, const model::NodeTable& nodes,
              std::vector<SurfaceGrid> surfaces, std::optional<Vec3> mirror, flow::SharedFlow flow,
              LatticeSetting setting, LatticeTangent tangent = LatticeTangent::apparent_mass);

  /// One per group of grid points on the same nodes, and one of all nodes for the whole tangent.
  int size() const override {
    return static_cast<int>(items_.size()) + (tangent_ == LatticeTangent::whole ? 1 : 0);
  }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  /// The step needs velocities at its end.
  bool needs_mean_velocity() const override { return true; }
  bool needs_all_nodes() const override { return true; }

  void prepare(const model::State& state, const Stencil& stencil) override;
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  std::vector<double> delays(const model::State& state) const override;
  Verdict assemble_delayed(const model::State& state, const Stencil& stencil, double delay,
                           model::Target& target) override;
  void accept(model::State& state) override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

  std::size_t memory_size() const override;
  void save(model::Items which, std::span<double> memory) const override;
  void restore(std::span<const double> memory) override;

  const Lattice& lattice() const { return lattice_; }
  /// The flow at the end of the last accepted step.
  const FluidState& fluid() const { return accepted_; }
  /// Forces at grid points in it [N].
  const Points& forces() const { return accepted_forces_; }
  std::optional<Resultant> resultant() const override;
  double range_used() const override { return counts() ? range_used_ : 0.0; }
  std::string range_warning(double used) const override;
  std::string left_out_of_modes() const override;
  /// That carry grid points, in rising order.
  const std::vector<int>& nodes() const { return carriers_; }
  /// Refuses linearisations whose matrices need more memory, by an InputError at `where`.
  void limit_linearisations(double bytes, Where where) {
    allowed_ = bytes;
    where_ = std::move(where);
  }
  /// Grid points in a configuration.
  Points grid(const model::Coordinates& q) const;

 private:
  /// Grid points that hang on the same nodes.
  struct Item {
    std::vector<int> nodes;
    std::vector<std::size_t> points;
    std::vector<Eigen::VectorXd> factors;  ///< T_s of each point, four per node
  };

  /// What components of slots of the carriers do to the grid, by column; those that do nothing are
  /// left out.
  struct SlotMotions {
    std::vector<Eigen::Index> slots;
    Eigen::MatrixXd motions;
  };

  void add_items(const std::vector<SurfaceGrid>& surfaces);
  void add_carriers();
  void compute_apparent_masses();
  bool is_coupling(int item) const { return item == static_cast<int>(items_.size()); }
  /// The step as it is tried.
  GridStep step_to(const model::State& state) const;
  /// Sets `stiffness_`, minus the derivative of the forces on all slots of the carriers by them at
  /// the end of the step, of a result that is at hand.
  void find_stiffness(const model::State& state);
  void refuse_large_linearisation() const;
  /// What linearisations about a state have beside it.
  const LaggedAir& air_at(const model::State& state) const;
  SlotMotions motions_of_slots() const;
  /// Adds a matrix between all slots of the carriers.
  Verdict assemble_coupling(const Eigen::MatrixXd& matrix, const model::State& state,
                            const Stencil& stencil, model::Target& target) const;
  /// Whether this rank counts what belongs to all items: the one that owns the first.
  bool counts() const;
  static Resultant resultant_of(const Points& forces, const Points& places);
  const FluidResult& result_at(const model::State& state) const;
  Vec3 normal_at(std::size_t point, const Points& grid) const;
  /// How far the surfaces go beyond what a lattice is good for, `range_used`.
  double used_at(const Points& grid, const Points& velocity, double time) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        bool tangent, const Points& forces, model::Target& target) const;
  template <class Space>
  Verdict assemble_coupling(std::size_t i, const Eigen::MatrixXd& matrix, const model::State& state,
                            const Stencil& stencil, model::Target& target) const;

  const model::NodeTable& nodes_;
  std::vector<Item> items_;
  Lattice lattice_;
  LatticeTangent tangent_;
  std::vector<int> carriers_;  ///< nodes
  /// By carrier: a point of the grid that hangs on it, with what its slots do for it.
  std::vector<std::vector<std::pair<std::size_t, Vec<4>>>> carried_;
  double density_ = 0.0;
  std::vector<double> apparent_mass_;  ///< half of that of strips, by grid point [kg]

  FluidState accepted_;
  Points accepted_forces_;
  std::optional<Resultant> resultant_;
  double range_used_ = 0.0;

  // of the step that is tried
  double step_ = 0.0;
  bool knows_stiffness_ = false;
  Eigen::MatrixXd stiffness_;  ///< twelve per carrier [N/m]
  Points start_, start_velocity_;
  Lattice::ComingWake coming_;
  mutable model::Coordinates evaluated_;  ///< where result_ was computed; empty: nowhere
  mutable FluidResult result_;

  // of a linearisation
  double allowed_ = std::numeric_limits<double>::infinity();  ///< memory [B]
  Where where_;
  bool linearises_ = false;
  mutable LaggedAir air_;
  mutable model::Coordinates linearised_;  ///< where air_ was found; empty: nowhere
  mutable double linearised_at_ = 0.0;     ///< and when [s]
};

}  // namespace culm::lattice
