#include <culm/base/nearest.hpp>
#include <culm/math/rotation.hpp>
#include <culm/simulation/quantity.hpp>

#include "place.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <string>
#include <utility>

namespace culm::simulation {
namespace {

using model::NodeTable;
using output::HistoryColumn;

// What is watched.
struct Watched : Place {
  std::string constraint;  // whose reaction; all if empty
  bool is_fixed = false;   // by that constraint, which takes unknowns away
};

// A quantity that is a function of one node.
class NodeQuantity final : public Quantity {
 public:
  using Evaluate = std::function<void(const assembly::System&, const model::State&, const Watched&,
                                      std::vector<double>&)>;

  using Object = std::string (*)(const model::Model&, const Watched&);

  NodeQuantity(const Watched& place, std::vector<HistoryColumn> columns, Evaluate evaluate,
               bool reads_nodes_only, Object object)
      : place_(place),
        columns_(std::move(columns)),
        evaluate_(std::move(evaluate)),
        reads_nodes_only_(reads_nodes_only),
        object_(object) {}

  std::vector<HistoryColumn> columns() const override { return columns_; }
  std::optional<std::vector<int>> nodes() const override {
    if (!reads_nodes_only_) return {};
    return place_.frame < 0 ? std::vector{place_.node} : std::vector{place_.node, place_.frame};
  }
  void evaluate(const assembly::System& system, const model::State& state,
                std::vector<double>& numbers) const override {
    evaluate_(system, state, place_, numbers);
  }
  std::string objection(const model::Model& model) const override {
    return object_ == nullptr ? std::string() : object_(model, place_);
  }

 private:
  Watched place_;
  std::vector<HistoryColumn> columns_;
  Evaluate evaluate_;
  bool reads_nodes_only_;  // no forces
  Object object_;
};

void append(const Vec3& v, std::vector<double>& numbers) {
  numbers.insert(numbers.end(), v.data(), v.data() + 3);
}

void position(const assembly::System&, const model::State& state, const Watched& place,
              std::vector<double>& numbers) {
  append(place.seen_position(state.next), numbers);
}

void displacement(const assembly::System& system, const model::State& state, const Watched& place,
                  std::vector<double>& numbers) {
  append(place.seen_position(state.next) - place.seen_position(system.model().nodes().reference()),
         numbers);
}

void velocity(const assembly::System&, const model::State& state, const Watched& place,
              std::vector<double>& numbers) {
  append(place.seen_velocity(state), numbers);
}

void angular_velocity(const assembly::System&, const model::State& state, const Watched& place,
                      std::vector<double>& numbers) {
  append(place.seen_spin(state), numbers);
}

// The shortest rotation that turns one direction into another.
Vec3 turn_between(const Vec3& from, const Vec3& to) {
  const Vec3 axis = from.cross(to);
  const double sine = axis.norm();
  const double cosine = from.dot(to);
  if (sine > 0.0) return std::atan2(sine, cosine) / sine * axis;
  return cosine < 0.0 ? Vec3(std::numbers::pi * any_normal(from)) : Vec3(Vec3::Zero());
}

void rotation(const assembly::System& system, const model::State& state, const Watched& place,
              std::vector<double>& numbers) {
  const auto& reference = system.model().nodes().reference();
  if (system.model().nodes().kind(place.node) != NodeKind::node12) {
    append(turn_between(NodeTable::slots(reference, place.node).col(1),
                        NodeTable::slots(state.next, place.node).col(1)),
           numbers);
    return;
  }
  const Mat3 D = place.seen_directors(state.next);
  const Mat3 D0 = place.seen_directors(reference);
  append(log_rotation(D * D0.transpose()), numbers);
}

void reaction(const assembly::System& system, const model::State& state, const Watched& place,
              std::vector<double>& numbers) {
  Vec6 r = Vec6::Zero();
  if (!place.constraint.empty()) r = system.reaction_of(place.constraint, place.node, state);
  if (place.constraint.empty() || place.is_fixed) r += system.reaction(place.node, state);
  if (place.is_fixed) r -= system.reaction_of("", place.node, state);  // all equations
  numbers.insert(numbers.end(), r.data(), r.data() + 6);
}

// The force of a connection that takes the unknowns of a node away is in no equation.
std::string object_to_reaction(const model::Model& model, const Watched& place) {
  const model::NodeTable& nodes = model.nodes();
  const bool is_equation = !place.constraint.empty() && !place.is_fixed;
  if (is_equation || !nodes.is_slave(place.node)) return {};
  std::string connection = "a rigid connection";
  for (const model::Constraint& c : model.constraints()) {
    if (c.link && c.link->slave == place.node) connection = c.type + " '" + c.name + "'";
  }
  const std::string master = model.node_name(nodes.master(place.node));
  return "'" + model.node_name(place.node) + "' follows '" + master + "' by " + connection +
         ", which takes its unknowns away, so the force that it carries is not known; watch '" +
         master +
         "' for what holds both, take a Weld instead of the connection, or "
         "Solver / Form = Multipliers";
}

// Another constraint that takes unknowns of a node away; empty if there is none.
std::string other_support(const model::Model& model, const model::Constraint& one, int node) {
  for (const model::Constraint& c : model.constraints()) {
    if (c.fix && c.fix->node == node && c.name != one.name) return c.name;
  }
  return {};
}

// False, and an issue, if there is no such constraint there or its share is not known.
bool read_constraint(const Options& options, model::BuildContext& context, Watched& place) {
  if (!options.has("Constraint")) return true;
  place.constraint = options.text("Constraint");
  std::vector<std::string> names;
  for (const model::Constraint& c : context.model.constraints()) {
    if (std::find(c.nodes.begin(), c.nodes.end(), place.node) == c.nodes.end()) continue;
    names.push_back(c.name);
    if (c.name != place.constraint) continue;
    const std::string other = c.fix ? other_support(context.model, c, place.node) : std::string();
    place.is_fixed = c.fix.has_value();
    if (!c.link && other.empty()) return true;
    const std::string beside = other.empty() ? "" : ", and '" + other + "' holds the node as well";
    context.issues.add(options.where("Constraint"),
                       c.type + " '" + c.name + "' is no equation" + beside +
                           ", so its share of the reactions of the node is not known");
    return false;
  }
  context.issues.add(options.where("Constraint"), "no constraint '" + place.constraint +
                                                      "' acts on '" +
                                                      context.model.node_name(place.node) + "'" +
                                                      did_you_mean(place.constraint, names));
  return false;
}

// The node of a constraint that names one, the second of a joint of two; or none, and an issue. A
// support of two nodes, or of a point between them, has a share of its force at each.
std::optional<int> node_of_constraint(const Options& options, model::BuildContext& context) {
  if (!options.has("Constraint")) {
    context.issues.add(options.where(), "needs a 'Node', the name of a 'Constraint', or both");
    return {};
  }
  const std::string& wanted = options.text("Constraint");
  std::set<int> nodes;
  std::vector<std::string> names;
  int last = -1;
  bool is_joint = true;
  for (const model::Constraint& c : context.model.constraints()) {
    if (c.is_structural) continue;
    names.push_back(c.name);
    if (c.name != wanted || c.nodes.empty()) continue;
    nodes.insert(c.nodes.begin(), c.nodes.end());
    last = c.nodes.back();
    is_joint = is_joint && c.is_internal;
  }
  if (nodes.size() == 1 || (nodes.size() == 2 && is_joint)) return last;
  context.issues.add(options.where("Constraint"),
                     nodes.empty() ? "no constraint '" + wanted + "'" + did_you_mean(wanted, names)
                                   : "'" + wanted + "' acts on " + std::to_string(nodes.size()) +
                                         " nodes, with a share of its force at each; name "
                                         "one of them as 'Node'");
  return {};
}

// Whether a node turns as a whole: with a frame, or for an angular velocity, a director does not
// do.
bool has_triad_where_needed(const std::string& type, const Options& options,
                            model::BuildContext& context, const Watched& place) {
  const bool needed = type == "Angular Velocity" || (type == "Rotation" && place.frame >= 0);
  return !needed || has_triad(place.node, "Node", options, context);
}

void add(QuantityRegistry& registry, Schema schema, std::vector<HistoryColumn> columns,
         NodeQuantity::Evaluate evaluate, NodeQuantity::Object object = nullptr) {
  const std::string type = schema.name();
  const bool has_offset = schema.find_field("Offset") != nullptr;
  const bool has_frame = schema.find_field("Frame") != nullptr;
  const bool has_constraint = schema.find_field("Constraint") != nullptr;
  schema.add(has_constraint ? model::node_field(
                                  "Node",
                                  "The node, such as 'structure/last'; if absent, the second of "
                                  "the joint, or the one of the support, that 'Constraint' names.")
                                  .optional()
                            : model::node_field("Node", "The node, such as 'structure/last'."));
  registry.add(
      type, std::move(schema),
      [type, columns = std::move(columns), evaluate = std::move(evaluate), object, has_offset,
       has_frame, has_constraint](const Options& options,
                                  model::BuildContext& context) -> std::unique_ptr<Quantity> {
        std::optional<Place> read;
        if (!has_constraint || options.has("Node")) {
          read = read_place(options, has_offset, has_frame, context);
        } else if (const std::optional<int> node = node_of_constraint(options, context)) {
          read = Place{*node, Vec3::Zero(), -1};
        }
        if (!read) return nullptr;
        Watched place{*read, {}};
        if (has_constraint && !read_constraint(options, context, place)) return nullptr;
        if (!has_triad_where_needed(type, options, context, place)) return nullptr;
        return std::make_unique<NodeQuantity>(place, columns, evaluate, !has_constraint, object);
      });
}

}  // namespace

void register_node_quantities(QuantityRegistry& registry) {
  add(registry,
      Schema("Position", "Position of a node or a point fixed to it.")
          .add(offset_field())
          .add(frame_field()),
      {{"x", "m"}, {"y", "m"}, {"z", "m"}}, position);
  add(registry,
      Schema("Displacement", "Displacement of a node, or a point fixed to it, from the reference.")
          .add(offset_field())
          .add(frame_field()),
      {{"ux", "m"}, {"uy", "m"}, {"uz", "m"}}, displacement);
  add(registry,
      Schema(
          "Rotation",
          "Rotation vector of the directors of a node from the reference; of a node of a shell the "
          "shortest that turns its director.")
          .add(frame_field()),
      {{"rx", "rad"}, {"ry", "rad"}, {"rz", "rad"}}, rotation);
  add(registry,
      Schema("Velocity", "Velocity of a node, or a point fixed to it; zero in statics.")
          .add(offset_field())
          .add(frame_field()),
      {{"vx", "m/s"}, {"vy", "m/s"}, {"vz", "m/s"}}, velocity);
  add(registry,
      Schema("Angular Velocity", "Angular velocity of a node with directors; zero in statics.")
          .add(frame_field()),
      {{"wx", "rad/s"}, {"wy", "rad/s"}, {"wz", "rad/s"}}, angular_velocity);
  add(registry,
      Schema("Reaction",
             "Force, and moment about the node, by which supports and joints act on the structure "
             "there.")
          .add(text("Constraint",
                    "The only one to count: a joint, a drive, a moving support; all if absent.")
                   .optional()),
      {{"Fx", "N"}, {"Fy", "N"}, {"Fz", "N"}, {"Mx", "N m"}, {"My", "N m"}, {"Mz", "N m"}},
      reaction, object_to_reaction);
}

}  // namespace culm::simulation
