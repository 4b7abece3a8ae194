/// The discrete equations of a model on this rank: residual, tangent, and the update of the state.
#pragma once

#include <culm/assembly/column_values.hpp>
#include <culm/assembly/layout.hpp>
#include <culm/assembly/node_motions.hpp>
#include <culm/base/ledger.hpp>
#include <culm/base/snapshot.hpp>
#include <culm/model/model.hpp>
#include <culm/model/reaction_source.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace culm::assembly {

/// What an evaluation found; the same on all ranks.
struct Evaluation {
  Verdict verdict = Verdict::ok;
  double force_residual = 0.0;        ///< largest entry of the force rows [N, N m]
  double force_scale = 0.0;           ///< largest force of any item, what the residual is judged by
  double constraint_violation = 0.0;  ///< largest |h|, lengths over the model's length [-]
};

/// Energies of the whole model at one time.
struct Energies {
  double kinetic = 0.0;    ///< [J]
  double strain = 0.0;     ///< [J]
  double potential = 0.0;  ///< of loads that have one [J]
  /// Sizes of all of which these are sums: what rounding takes its share of [J].
  double amount = 0.0;
  double total() const { return kinetic + strain + potential; }
};

/// Where the forces of a load go at a state.
struct LoadShare {
  double whole = 0.0;   ///< largest force on any unknown, taken away by a support or not [N, N m]
  double moving = 0.0;  ///< the same of what supports at its nodes do not take [N, N m]
};

/// How fast a slot of a node is [m/s]. A director counts at a length, that of the model.
inline double speed_of(int slot, const Vec3& rate, double length) {
  return slot == 0 ? rate.norm() : length * rate.norm();
}

/// A change of velocities by which they fit the constraints.
struct VelocityFit {
  double change = 0.0;   ///< the largest, by speed_of() [m/s]
  bool is_turn = false;  ///< whether that is of a director
  int node = -1;         ///< where that is; -1 where nothing changes
  int equation = -1;     ///< of the model, the one that was violated most; -1 if none was
};

class GhostImport;

/// Owns residual and matrix; the model is borrowed.
class System {
 public:
  System(model::Model& model, const parallel::Comm& comm, Ledger& ledger);
  ~System();

  /// Before each attempt of a step, with the accepted state in state.prev.
  void prepare(const model::State& state, const Stencil& stencil);
  /// Once per step that is accepted, after its last evaluation at state.next, in dynamics with the
  /// velocity of its end: makes the end of the step the start of the next one, also of what batches
  /// carry.
  void accept(model::State& state);
  /// Shows what accept() would make of an attempt, also of what batches carry that can go back,
  /// and takes it back. Collective. @param velocity  at the end of the attempt
  void preview(const model::State& state, const model::Coordinates& velocity,
               const Stencil& stencil, const std::function<void(model::State&)>& look);
  /// Asks for the values of an accepted state that batches follow in the next step; collective.
  using Sampler = std::function<void(model::State&)>;
  void set_sampler(Sampler sampler) { sampler_ = std::move(sampler); }
  /// Has them taken; before the first step and after each one that was accepted.
  void sample(model::State& state) const {
    if (sampler_) sampler_(state);
  }
  /// Instead: goes back to the start of the step.
  void discard(model::State& state) const;
  /// Tells what depends on time itself, such as loads, constraints and heat, of another end of the
  /// step, state.time; other elements do not know it.
  void change_level(const model::State& state, const Stencil& stencil);
  /// Before the first step, for who looks at stresses and energies then: tells heat of state.time.
  void show_level(const model::State& state);
  /// Derivative of the residual by state.time: a difference over `step`, exact where loads are
  /// linear in time. Needs prepare; changes neither residual() nor reactions.
  void level_gradient(model::State& state, const Stencil& stencil, double step, Vector& gradient);
  /// Residual, and the tangent when wanted.
  Evaluation evaluate(const model::State& state, const Stencil& stencil, Want want);
  /// Relaxation times of all items, each once, rising [s].
  std::vector<double> relaxation_times() const;
  /// In place of the tangent, what all branches of one of these times add to it at state.next if
  /// their springs follow at once.
  Verdict evaluate_branches(const model::State& state, double time);
  /// Times of forces that follow with a delay, about a steady state, each once, rising [s].
  /// Collective.
  std::vector<double> delays(const model::State& state) const;
  /// In place of the tangent, what it gains where those of one of these times stand still.
  Verdict evaluate_delayed(const model::State& state, const Stencil& stencil, double delay);
  /// Moves state.next by the solution of the linear system, factor included: nodes
  /// multiplicatively, eliminated nodes after their masters, multipliers additively.
  void move(model::State& state, const Vector& increment, double factor);
  /// How the slots of all nodes that this rank needs move with an increment at state.next, to first
  /// order. @return valid until the next call and the next extrapolate
  const model::Coordinates& linear_motion(const model::State& state, const Vector& increment,
                                          double factor);
  /// Predicts stresses for the next tangent from the same increment, before move.
  void extrapolate(const model::State& state, const Stencil& stencil, const Vector& increment,
                   double factor);
  /// Brings coordinates, multipliers and reactions of all nodes up to date on all ranks.
  void synchronise(model::State& state);
  /// The end of the step, with all nodes on rank 0 for output and those of its own on the others,
  /// and with all multipliers and reactions; its start is its end, and what only steps need is
  /// empty. Collective.
  model::State gather(const model::State& state);
  /// An array over the slots of all nodes, with all of them on rank 0 and those of its own on the
  /// others. Collective.
  model::Coordinates gather(const model::Coordinates& values) const;
  /// Takes the nodes from a state that no row of this rank needs, and their memory: they are zero
  /// until they are synchronised again.
  void forget_others(model::State& state) const;
  /// Takes the items from all batches that no row of this rank needs. From then on what asks for
  /// single items of the model asks their owners.
  void forget_other_items();
  /// The same of coordinates and velocities of some nodes only, each named once.
  void synchronise(model::State& state, std::span<const int> nodes) const;
  /// Brings an array over the slots of all nodes up to date on all ranks: each value from the rank
  /// that owns the node, exactly.
  void complete(model::Coordinates& values) const;
  /// Writes an array over the slots of all nodes, and takes it back; collective where the snapshot
  /// is for files. Throws FileError if it does not fit.
  void save(const model::Coordinates& values, std::string_view name, Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot, std::string_view name, model::Coordinates& values) const;
  /// Writes the state, and what system and batches remember from step to step. Collective where the
  /// snapshot is for files.
  void save(model::State& state, Snapshot& snapshot);
  /// Writes the present values of the matrix, for factors that serve on; collective where the
  /// snapshot is for files.
  void save_matrix(Snapshot& snapshot) const;
  /// Takes them back. @return false with another number of ranks, where they do not fit
  bool restore_matrix(const Snapshot& snapshot);
  /// Whether a snapshot has as many numbers of each kind as save writes.
  bool fits(const Snapshot& snapshot, const model::State& state) const;
  /// Goes back to what save wrote; on any number of ranks. Throws FileError if it does not fit.
  void restore(const Snapshot& snapshot, model::State& state);
  /// From now on the impulse that a step leaves unbalanced acts in the next one: what iteration and
  /// rounding leave then cancels from step to step instead of adding up, and momenta do not drift.
  /// Or no longer.
  void carry_residuals(bool wanted);
  /// Notes what is out of balance at a state in statics, where loads act at once that nothing has
  /// answered yet, to be taken up bit by bit.
  Evaluation note_unbalance(const model::State& state, const Stencil& stencil);
  /// How much of what was noted stays out of evaluations in statics from now on, from 1 to 0.
  void hold_back(double share) { held_share_ = share; }
  /// Chooses the scale of multipliers from the tangent at a state, so that force and constraint
  /// rows have entries of one size. @source formulation 4.2
  void choose_multiplier_scale(const model::State& state, const Stencil& stencil,
                               Want want = Want::residual_and_tangent);

  /// From now on remembers where it takes each tangent, for node_motions.
  void watch_tangents() { watches_tangents_ = true; }
  /// How rigid motions move the unknowns of this rank where the last tangent was taken; at the
  /// reference before the first one.
  NodeMotions node_motions() const;

  /// Motions of the six unknowns of nodes, or their rates: of those nodes that this rank needs and
  /// that have unknowns of their own, its own ones first and each part in the order of the model.
  using Motions = std::vector<Vec6>;
  std::size_t num_motions() const { return moving_nodes_.size(); }
  /// How many of them belong to nodes of this rank.
  std::size_t num_own_motions() const { return num_own_motions_; }
  /// Those from number `first` on, from the start of the step to state.next [m, rad].
  void motions(const model::State& state, std::size_t first, std::span<Vec6> motions) const;
  /// At the start of the step [m/s, rad/s].
  void velocities(const model::State& state, std::size_t first, std::span<Vec6> velocities) const;
  /// Tells motions from number `first` on.
  using MotionSource = std::function<void(std::size_t first, std::span<Vec6> motions)>;
  /// Moves state.next by motions, except where supports hold it; asks for some after others.
  void move_nodes(model::State& state, const MotionSource& tell) const;
  /// Writes motions and takes them back, as numbers of all nodes where the snapshot is for files;
  /// collective there.
  void save(const Motions& motions, std::string_view name, Snapshot& snapshot) const;
  Motions restore_motions(const Snapshot& snapshot, std::string_view name) const;
  /// The velocity that follows from supports, links and constraints, the nearest one to that of the
  /// state in the metric of the mass, H v = dg/dt. The speed of prescribed motions is found by
  /// differences over times up to `probe` [s]. `solve_mass` solves with the matrix as it stands
  /// when it is called. There are no reactions afterwards until the next evaluation. @param fitted
  /// becomes the velocity
  /// @return by what it differs from the state's @source formulation 4.7
  using Solve = std::function<void(const Vector& b, Vector& x)>;
  VelocityFit project_velocity(model::State& state, double probe, const Solve& solve_mass,
                               model::Coordinates& fitted);

  /// Strain energy of all elements [J].
  double strain_energy(const model::Coordinates& q) const;
  /// @param kinetic  that of the velocity at q [J]
  Energies energies(const model::Coordinates& q, double kinetic) const;
  double kinetic_energy(const model::Coordinates& velocity) const;
  model::Momentum momentum(const model::Coordinates& q, const model::Coordinates& velocity) const;
  double multiplier_scale() const { return multiplier_scale_; }

  /// Force [N] and moment about the node [N m] by which supports and joints act on the structure
  /// there: of the last evaluation where they take unknowns away, of the state's multipliers where
  /// they are equations. Call synchronise first; the same on all ranks.
  Vec6 reaction(int node, const model::State& state) const;
  /// No evaluation counts any more, as where another analysis begins: there are no reactions, and
  /// no forces of the last step.
  void forget_evaluation();
  /// The share of one constraint that is kept as equations, by its name.
  Vec6 reaction_of(const std::string& constraint, int node, const model::State& state) const;

  /// What of a dead or follower load at state.next supports take: those that take unknowns away,
  /// those on single nodes that are equations, and joints to what is held. Collective; changes
  /// neither residual() nor reactions.
  /// @param load  one of the model, with nothing to remember
  LoadShare share_of(model::Batch& load, const model::State& state) const;
  /// The same of many, which is faster than one by one.
  /// @param theta  point of the step to state.time where loads act
  std::vector<LoadShare> shares_of(std::span<model::Batch* const> loads, const model::State& state,
                                   double theta = 1.0) const;
  /// Force [N] and moment [N m] of such a load at state.next on each node, on the master of one
  /// that follows it. Collective; changes neither residual() nor reactions.
  std::vector<Vec6> forces_of(model::Batch& load, const model::State& state) const;

  /// Moves state.next to where all constraints hold at state.time, from there on as the nearest
  /// configuration in the metric of the mass. `solve_mass` as in project_velocity.
  /// There are no reactions afterwards until the next evaluation.
  /// @return largest change of a coordinate [m, 1]; infinite if they cannot be made to hold
  double project_position(model::State& state, const Solve& solve_mass);

  const Vector& residual() const { return residual_; }
  /// Row of its largest force on this rank; -1 if there is none.
  int largest_force_row() const { return largest_force_row_; }
  /// The tangent, or what was asked for in its place, of the last evaluation.
  const std::shared_ptr<const Matrix>& matrix() const { return matrix_view_; }
  /// Of its rows, see assembly::first_columns.
  std::span<const int> first_columns() const { return first_columns_; }
  /// Adds a share of itself to each entry on the diagonal of matrix() that belongs to a force, of
  /// the largest one where there is none, so that motions which nothing resists are resisted a
  /// little. Collective.
  void stiffen(double share);
  const Layout& layout() const { return layout_; }
  /// Whose blocks this rank owns, eliminated ones with their masters' included; rising.
  const std::vector<int>& owned_nodes() const { return owned_nodes_; }
  /// Whether rows of this rank depend on a node, which it keeps up to date then.
  bool needs(int node) const { return is_needed_[static_cast<std::size_t>(node)]; }
  const model::Model& model() const { return model_; }
  const parallel::Comm& comm() const { return comm_; }

 private:
  std::vector<double> memory(model::Items which) const;
  /// Rows of forces are those of nodes, the first ones.
  int num_force_rows() const { return layout_.num_node_rows(); }
  double find_largest_force();
  bool is_force_row(std::size_t row) const { return row < index(num_force_rows()); }
  void restore_memory(std::span<const double> memory);
  void forget_reactions() { std::fill(reactions_.begin(), reactions_.end(), 0.0); }
  std::size_t memory_size() const;
  model::Target target();
  model::Target target_with_matrix();
  void assemble_alone(model::Batch& load, const model::State& state, double theta,
                      std::span<double> residual, std::span<double> taken) const;
  Vec6 equation_reaction(const std::string& constraint, int node, const model::State& state) const;
  std::pair<double, int> find_largest(double value, int place) const;
  int largest_equation(std::span<const double> rows, double largest) const;
  double largest_diagonal() const;
  void carry_residual(double factor);
  void find_needed_nodes();
  void gather_forces(model::State& state);
  void gather_nodes(std::span<const double> own, std::size_t of_node, std::span<double> all) const;
  void save_nodes(std::function<std::vector<double>()> find_own, std::size_t of_node,
                  std::string_view name, Snapshot& snapshot) const;
  std::vector<double> own_motions(const Motions& motions) const;
  std::vector<double> own_slots(const model::Coordinates& values) const;
  void save_carried(Snapshot& snapshot) const;
  std::size_t first_entry() const;
  void restore_carried(const std::vector<double>& all);
  std::vector<double> drive_speed(model::State& state, double probe);
  ColumnValues column_values(const Vector& increment);

  model::Model& model_;
  parallel::Comm comm_;
  Ledger& ledger_;
  Layout layout_;
  std::vector<model::Batch*> batches_;
  std::vector<const model::MassSource*> masses_;
  std::vector<const model::ReactionSource*> reaction_sources_;
  std::vector<model::Batch*> driven_;  ///< those that depend on time itself
  std::size_t driven_elements_ = 0;    ///< the first of them
  /// Effects of the batches: when they are evaluated, by what is wanted, and when they extrapolate.
  std::array<std::optional<Ledger::Round>, 3> evaluations_;
  std::optional<Ledger::Round> extrapolation_;
  Ledger::Id update_effect_;
  bool needs_all_nodes_ = false;   ///< on all ranks, up to date in each evaluation
  std::vector<int> slaves_;        ///< whose masters this rank needs
  std::vector<bool> is_needed_;    ///< by node
  std::vector<int> moving_nodes_;  ///< whose motions are told
  std::size_t num_own_motions_ = 0;
  std::vector<int> owned_nodes_;
  std::vector<double> reactions_;           ///< owned ones
  std::vector<double> gathered_reactions_;  ///< all
  std::shared_ptr<Matrix> matrix_;
  std::shared_ptr<const Matrix> matrix_view_;
  std::vector<int> first_columns_;
  Vector residual_;
  int largest_force_row_ = -1;
  std::unique_ptr<GhostImport> ghosts_;  ///< if there are several ranks
  std::vector<std::size_t> diagonal_;    ///< place of the diagonal entry of each owned row
  Sampler sampler_;
  bool carries_residuals_ = false;
  /// By owned row: impulses [N s, N m s], or in statics forces that were noted [N, N m].
  std::optional<std::vector<double>> carried_;
  double held_share_ = 0.0;
  model::Coordinates linear_increment_;
  double multiplier_scale_ = 1.0;
  bool watches_tangents_ = false;
  model::Coordinates tangent_point_;  ///< where the last tangent was taken; empty if none was
};

}  // namespace culm::assembly
