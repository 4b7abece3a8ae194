/// The whole mechanical system: nodes, structures, elements, constraints, loads.
#pragma once

#include <culm/model/amplitude.hpp>
#include <culm/model/batch.hpp>
#include <culm/model/constraint.hpp>
#include <culm/model/constraint_batch.hpp>
#include <culm/model/mass_batch.hpp>
#include <culm/model/nodal_input.hpp>
#include <culm/model/structure.hpp>

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace culm::model {

/// A node starts to move as part of a rigid motion.
struct InitialVelocity {
  int node = -1;
  Vec3 velocity = Vec3::Zero();  ///< of the point `about` [m/s]
  Vec3 omega = Vec3::Zero();     ///< [rad/s]
  Vec3 about = Vec3::Zero();     ///< [m]
};

/// A node starts displaced as part of a rigid motion: turned about a point, then shifted.
struct InitialDisplacement {
  Where where;  ///< in the deck
  int node = -1;
  Vec3 translation = Vec3::Zero();  ///< [m]
  Vec3 rotation = Vec3::Zero();     ///< rotation vector [rad]
  Vec3 about = Vec3::Zero();        ///< [m]
};

/// Filled by the builders of structures, constraints and loads, then frozen: numbering and batches
/// are fixed from there on.
class Model {
 public:
  Model();
  ~Model();
  Model(const Model&) = delete;  // batches refer to the node table
  Model& operator=(const Model&) = delete;

  // --- building ---------------------------------------------------------------------------------
  NodeTable& nodes() { return nodes_; }
  const NodeTable& nodes() const { return nodes_; }

  /// @return a structure that stays in place while others are added
  Structure& add_structure(std::string name);
  /// @see elements, in element_batch.hpp
  void add_element_batch(std::unique_ptr<Batch> batch);
  /// The batch of masses with this ledger name, made when it is first asked for.
  MassBatch& masses(const Effect& effect);
  /// Sets the velocity that a node has at the start of a dynamic analysis, v + omega x (p - about)
  /// for every point p of the node; constraints are imposed later.
  void add_initial_velocity(const InitialVelocity& velocity);
  /// Displaces a node at the start, after what was added before.
  void add_initial_displacement(const InitialDisplacement& displacement);
  /// Nodes under one name, for select_nodes.
  void add_node_set(const std::string& name, std::vector<int> nodes);
  /// Elements of a structure under one name, by their numbers in the deck.
  void add_element_set(std::string name, const Structure& structure,
                       const std::vector<int>& elements);
  void add_constraint(Constraint constraint);
  /// Unknowns for a batch that writes their rows. @return number of the block
  int add_own_block(OwnBlock block);
  /// Gives an unknown of a batch its value at the start.
  void set_initial(const Signal& signal, double value);
  /// A rigid link by elimination: `slave` follows `master`; twelve rows in the multiplier form.
  void add_rigid_link(std::string name, int slave, int master);
  void add_load(std::unique_ptr<Batch> load);
  /// A load that a program sets, by its name in the deck.
  void add_input(const std::string& name, std::unique_ptr<NodalInput> input);
  /// A signal that a program sets, by its name in the deck.
  void add_setting(const std::string& name, const Signal& signal);
  /// Notes a function of the deck that a load or a constraint follows.
  void add_function(const std::string& name, const Amplitude& function);

  /// Keeps equations that follow from others; for tests that look at rows one by one.
  void keep_redundant_rows() { keeps_redundant_rows_ = true; }
  /// Chooses the form, eliminates what can be eliminated and numbers the unknowns. Throws
  /// InputError where constraints contradict each other or the initial displacements.
  /// @return notes for the user, on constraints that others make superfluous
  std::vector<std::string> freeze(Form form);

  // --- reading ----------------------------------------------------------------------------------
  const std::deque<Structure>& structures() const { return structures_; }
  const Structure* find_structure(std::string_view name) const;
  /// Points for loads per length of a structure, an element set or "structure/edge"; empty when it
  /// is no line.
  std::vector<LinePoint> line_points(std::string_view name) const;
  /// Faces of a structure, or of "structure/part"; empty when it has none.
  std::vector<Face> faces(std::string_view name) const;
  /// Nodes named by "structure/number", "structure/set", "structure" or the name of a node set;
  /// empty when there are none.
  std::vector<int> select_nodes(std::string_view name) const;
  /// All names select_nodes understands except numbers, for messages.
  std::vector<std::string> selectable_names() const;
  /// "structure/number" of a node, or its place in a refined mesh where the deck has no number.
  std::string node_name(int node) const;
  /// The structure of a node, or null.
  const Structure* structure_of(int node) const;

  const std::vector<Constraint>& constraints() const { return constraints_; }
  /// Constraint numbers that are equations, by their number in the UnknownTable.
  const std::vector<Constraint>& equations() const { return equations_; }
  const UnknownTable& unknowns() const { return unknowns_; }
  const std::vector<OwnBlock>& own_blocks() const { return own_blocks_; }
  /// Whether unknown i of a block is the force of an equation: a multiplier.
  bool is_force(const Block& block, int i) const;
  /// One unknown of such a block, for those that follow it.
  Signal signal(int block, int place) const;
  /// All batches: elements, constraints, loads.
  std::vector<Batch*> batches() const;
  const std::vector<std::unique_ptr<Batch>>& element_batches() const { return element_batches_; }

  const std::vector<std::unique_ptr<Batch>>& loads() const { return loads_; }
  /// Loads that a program sets, by name.
  const std::map<std::string, std::unique_ptr<NodalInput>>& inputs() const { return inputs_; }
  /// Signals that a program sets, by name.
  const std::map<std::string, Signal>& settings() const { return settings_; }
  /// Functions of the deck that are followed, by name.
  const std::map<std::string, Amplitude>& functions() const { return functions_; }
  /// What varies in time beside functions, such as a field where it acts, by what to call it.
  void add_variation(const std::string& name, const Amplitude& variation);
  const std::map<std::string, Amplitude>& variations() const { return variations_; }
  const std::vector<std::unique_ptr<ConstraintBatch>>& constraint_batches() const {
    return constraint_batches_;
  }

  /// Mass times acceleration over all structures, in director coordinates: whole at the nodes of
  /// this rank, and everywhere until batches forget the items of others.
  Coordinates mass_times(const Coordinates& acceleration) const;
  /// Total mass [kg].
  double mass() const;
  /// Diagonal of the box around all nodes [m]; 1 for a single point.
  double length() const;
  bool has_initial_displacements() const { return !initial_displacements_.empty(); }
  /// The reference configuration, displaced as the deck says, with zero multipliers, at rest.
  State initial_state() const;
  /// Adds the initial velocities that the deck gives, at a configuration.
  void add_initial_velocities(const Coordinates& q, Coordinates& velocity) const;

 private:
  bool eliminate(const Constraint& constraint);
  Coordinates initial_configuration() const;
  void refuse_displaced_supports(double length) const;
  std::vector<std::string> remove_redundant_equations(Form form);
  void batch_equations(double length);

  NodeTable nodes_;
  std::deque<Structure> structures_;
  std::map<std::string, const Structure*, std::less<>> structure_by_name_;
  std::map<std::string, std::vector<int>> node_sets_;
  std::map<std::string, std::vector<LinePoint>> element_sets_;
  std::vector<std::unique_ptr<Batch>> element_batches_;
  std::vector<Constraint> constraints_;
  std::vector<Constraint> equations_;
  std::vector<OwnBlock> own_blocks_;
  std::vector<std::unique_ptr<ConstraintBatch>> constraint_batches_;
  std::vector<std::unique_ptr<Batch>> loads_;
  std::map<std::string, std::unique_ptr<NodalInput>> inputs_;
  std::map<std::string, Signal> settings_;
  std::map<std::string, Amplitude> functions_;
  std::map<std::string, Amplitude> variations_;
  std::vector<InitialVelocity> initial_velocities_;
  std::vector<InitialDisplacement> initial_displacements_;
  bool keeps_redundant_rows_ = false;
  std::optional<double> mass_, length_;  ///< once frozen
  UnknownTable unknowns_;
};

}  // namespace culm::model
