/// All items of one kind behind one virtual interface: one call per batch and iteration.
#pragma once

#include <culm/mechanics/stencil.hpp>
#include <culm/model/effect.hpp>
#include <culm/model/scatter.hpp>
#include <culm/model/state.hpp>

#include <Eigen/Core>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace culm::model {

/// The items a rank evaluates and where their numbers go. Made by assembly.
struct Placement {
  std::vector<int> items;   ///< items that touch an owned row
  std::vector<bool> owned;  ///< whether this rank counts the item in sums such as energy
  Scatter scatter;          ///< one entry per item above, same order
};

/// Which items of a rank.
enum class Items {
  owned,  ///< each item of the model on one rank
  local,  ///< all that a rank evaluates
};

/// What the owned items of a batch did in a step from state.prev to state.next.
struct StepWork {
  double external = 0.0;       ///< work of loads that have no potential [J]
  double drives = 0.0;         ///< work of prescribed motions [J]
  double damping = 0.0;        ///< energy taken by dampers and physical damping, >= 0 [J]
  double dissipation = 0.0;    ///< energy taken by numerical dissipation, >= 0 [J]
  Vec3 force = Vec3::Zero();   ///< resultant of the external forces at theta [N]
  Vec3 moment = Vec3::Zero();  ///< their moment about the origin [N m]

  StepWork& operator+=(const StepWork& other) {
    external += other.external;
    drives += other.drives;
    damping += other.damping;
    dissipation += other.dissipation;
    force += other.force;
    moment += other.moment;
    return *this;
  }
};

/// Items of one kind: elements of one type, one load, the constraints.
class Batch {
 public:
  virtual ~Batch() = default;

  /// What it is, for the ledger of effects and for those who look for it.
  virtual const Effect& effect() const = 0;
  virtual int size() const = 0;
  /// Blocks of unknowns that an item couples, in the order its kernel writes them.
  virtual std::vector<int> blocks(int item, const UnknownTable& unknowns) const = 0;
  /// Whether items add to the tangent between their blocks. Dead loads do not.
  virtual bool has_tangent() const = 0;

  /// Once before the first step.
  virtual void place(Placement placement, Form form) = 0;
  /// From now on nobody asks for items that this rank does not evaluate: what they hold may go.
  virtual void forget_others() {}
  /// Before each attempt of a step, when state.prev is accepted and state.time is the end of the
  /// step: any number of times, and as if it were the first.
  virtual void prepare(const State& state, const Stencil& stencil) = 0;
  /// Adds residual and, when wanted, tangent of all local items. Allocates nothing.
  virtual Verdict assemble(const State& state, const Stencil& stencil, Want want,
                           Target& target) = 0;
  /// Predicts the stresses for the geometric part of the next tangent from the linear increment
  /// `increment` of the coordinates of state.next. @source formulation 5.2
  virtual void extrapolate(const State& state, const Stencil& stencil,
                           const Coordinates& increment) = 0;

  /// Once per accepted step, while state.prev is still its start and state.next, which was
  /// evaluated last, its end: what items carry from step to step moves on. In dynamics
  /// state.velocity is that of the end, and a batch that says needs_mean_velocity may change it.
  virtual void accept(State&) {}
  /// What was shown of the last evaluation, such as forces, counts no more.
  virtual void forget_evaluation() {}
  /// Whether velocities must be those of the conserving scheme, for accept to correct them.
  virtual bool needs_mean_velocity() const { return false; }
  /// Whether it changes with time or level itself, beside the state. Of loads and constraints
  /// nobody asks: they are taken to.
  virtual bool depends_on_time() const { return false; }
  /// Whether what items do depends on the way on which a state was reached, as that of friction and
  /// plastic flow does, in statics too: what turns back within a step is lost.
  virtual bool depends_on_path() const { return false; }
  /// Times of the branches by which items relax [s]; none where stress follows strain at once. An
  /// equilibrium, about which equations are linearised, is relaxed.
  virtual std::vector<double> relaxation_times() const { return {}; }
  /// Adds to the tangent at state.next what all branches of one of these times have if their
  /// springs follow at once.
  virtual Verdict assemble_branches(const State&, double, Target&) { return Verdict::ok; }
  /// Whether an evaluation reads nodes that no item of this rank touches.
  virtual bool needs_all_nodes() const { return false; }

  /// Numbers that items carry from step to step beside the state, such as turns that were counted:
  /// how many, for all items of the model. Zero where prepare computes everything anew.
  virtual std::size_t memory_size() const { return 0; }
  /// Writes those of some items to their places in the array of all; leaves the others alone.
  virtual void save(Items, std::span<double>) const {}
  /// Takes them over for all local items; after place, before prepare.
  virtual void restore(std::span<const double>) {}
  /// Whether restore() takes back what accept() did. Not where something outside was told.
  virtual bool can_go_back() const { return true; }

  /// Energy stored in the owned items at a configuration [J]: strain energy, or the potential of a
  /// load that has one.
  virtual double stored_energy(const Coordinates& q) const = 0;
  /// Of a step from state.prev to state.next, which was evaluated last; before accept.
  virtual StepWork step_work(const State& state, const Stencil& stencil) const = 0;
};

/// Kinetic energy and momenta.
struct Momentum {
  double kinetic_energy = 0.0;  ///< [J]
  Vec3 linear = Vec3::Zero();   ///< [N s]
  Vec3 angular = Vec3::Zero();  ///< about the origin [N m s]

  Momentum& operator+=(const Momentum& other) {
    kinetic_energy += other.kinetic_energy;
    linear += other.linear;
    angular += other.angular;
    return *this;
  }
};

/// Has inertia.
class MassSource {
 public:
  virtual ~MassSource() = default;
  /// force += M acceleration over all items that are here, both in director coordinates: whole at
  /// each node of the rank, see Batch::forget_others.
  virtual void add_mass_times(const Coordinates& acceleration, Coordinates& force) const = 0;
  /// Hands out every item that is here: its nodes, and its mass between their slots, four per node
  /// in memory.
  using MassVisitor = std::function<void(std::span<const int> nodes, const Eigen::MatrixXd& mass)>;
  virtual void visit_masses(const MassVisitor& visit) const = 0;
  /// Of the owned items [J].
  virtual double kinetic_energy(const Coordinates& velocity) const = 0;
  /// Adds what the owned items contribute at a configuration and its velocity.
  virtual void add_momentum(const Coordinates& q, const Coordinates& velocity,
                            Momentum& momentum) const = 0;
};

/// Shows stress resultants of its items.
class ResultantSource {
 public:
  virtual ~ResultantSource() = default;
  virtual std::vector<std::string> resultant_names() const = 0;
  /// Whether this rank counts the item; exactly one does.
  virtual bool owns(int item) const = 0;
  /// Mean over the points of an item that is here, appended to `out`.
  virtual void resultants(int item, const Coordinates& q, std::vector<double>& out) const = 0;
};

}  // namespace culm::model
