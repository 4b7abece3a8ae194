#include <culm/joint/shell_connection.hpp>

#include "shell_pairs.hpp"
#include "supports.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

namespace culm::joint {
namespace {

using model::Constraint;

std::string name_at(const Options& options, const model::Model& model, int node) {
  return options.name() + " at " + model.node_name(node);
}

void add_named(Constraint joint, const std::string& type, const Options& options, int node,
               model::BuildContext& context) {
  joint.type = type;
  joint.name = name_at(options, context.model, node);
  joint.where = options.where();
  context.model.add_constraint(std::move(joint));
}

Vec3 position(const model::Model& model, int node) {
  return model::NodeTable::slots(model.nodes().reference(), node).col(0);
}
Vec3 director(const model::Model& model, int node) {
  return model::NodeTable::slots(model.nodes().reference(), node).col(1);
}

// Whether all nodes are of shells; an issue names the
// first that is not.
bool are_shells(const std::vector<int>& nodes, const std::string& parameter, const Options& options,
                model::BuildContext& context) {
  for (int node : nodes) {
    if (context.model.nodes().kind(node) == NodeKind::node6) continue;
    context.issues.add(options.where(parameter),
                       "node '" + context.model.node_name(node) + "' is not one of a shell");
    return false;
  }
  return true;
}

bool pairs_are_shells(const std::vector<std::pair<int, int>>& pairs, const Options& options,
                      model::BuildContext& context) {
  for (const auto& [first, second] : pairs) {
    if (!are_shells({first}, "First", options, context)) return false;
    if (!are_shells({second}, "Second", options, context)) return false;
  }
  return true;
}

std::vector<std::pair<int, int>> pairs_at_nodes(const Options& options,
                                                model::BuildContext& context) {
  return select_pairs(options, context,
                      [&](int node, int) { return position(context.model, node); });
}

// Thickness of the shell at a node; 0 where there is
// none.
double thickness_at(const model::Model& model, int node) {
  const model::Structure* structure = model.structure_of(node);
  if (structure == nullptr) return 0.0;
  for (const model::Face& face : structure->faces) {
    if (std::find(face.nodes.begin(), face.nodes.end(), node) != face.nodes.end()) {
      return face.thickness;
    }
  }
  return 0.0;
}

void build_hinge(const std::string& type, const Options& options, model::BuildContext& context) {
  for (const auto& [first, second] : pairs_at_nodes(options, context)) {
    add_named(hinge_connection(context.model.nodes(), first, second), type, options, second,
              context);
  }
}

void build_fold(const std::string& type, const Options& options, model::BuildContext& context) {
  const auto pairs = pairs_at_nodes(options, context);
  if (!pairs_are_shells(pairs, options, context)) return;
  for (const auto& [first, second] : pairs) {
    add_named(fold_connection(context.model.nodes(), first, second, options.flag("Inextensible")),
              type, options, second, context);
  }
}

// The second node takes place and director of the first;
// one that is not quite there keeps its difference by
// equations.
void build_smooth(const std::string& type, const Options& options, model::BuildContext& context) {
  const auto pairs = pairs_at_nodes(options, context);
  if (!pairs_are_shells(pairs, options, context)) return;
  model::Model& model = context.model;
  constexpr double round_off = 1e-10;
  for (const auto& [first, second] : pairs) {
    const Vec3 d = director(model, first);
    const Vec3 turned = director(model, second);
    if (d.normalized().cross(turned.normalized()).norm() > parallel_directors) {
      context.issues.add(options.where("Second"), "the directors of '" + model.node_name(second) +
                                                      "' and '" + model.node_name(first) +
                                                      "' are not parallel; a Fold Connection "
                                                      "keeps the angle");
      return;
    }
    const double gap = (position(model, first) - position(model, second)).norm();
    if (gap <= round_off * model.length() && (d - turned).norm() <= round_off * d.norm()) {
      model.add_rigid_link(name_at(options, model, second), second, first);
    } else {
      add_named(fold_connection(model.nodes(), first, second), type, options, second, context);
    }
  }
}

void build_layer(const std::string& type, const Options& options, model::BuildContext& context) {
  const model::Model& model = context.model;
  const auto pairs = select_pairs(options, context, [&](int node, int side) {
    const double half = (side == 0 ? 0.5 : -0.5) * thickness_at(model, node);
    return Vec3(position(model, node) + half * director(model, node));
  });
  if (!pairs_are_shells(pairs, options, context)) return;
  for (const auto& [first, second] : pairs) {
    add_named(layer_connection(model.nodes(), first, second, thickness_at(model, first),
                               thickness_at(model, second)),
              type, options, second, context);
  }
}

void build_inextensible(const std::string& type, const Options& options,
                        model::BuildContext& context) {
  const auto nodes = model::select_nodes(options, "Node", context);
  if (!are_shells(nodes, "Node", options, context)) return;
  for (int node : nodes) {
    add_named(inextensible_director(context.model.nodes(), node), type, options, node, context);
  }
}

void build_director_support(const std::string& type, const Options& options,
                            model::BuildContext& context) {
  const auto nodes = model::select_nodes(options, "Node", context);
  if (!are_shells(nodes, "Node", options, context)) return;
  for (int node : nodes) {
    add_named(director_support(context.model.nodes(), node, read_direction(options, "Direction")),
              type, options, node, context);
  }
}

void build_soft(const std::string& type, const Options& options, model::BuildContext& context) {
  const auto nodes = model::select_nodes(options, "Node", context);
  const auto masters = model::select_nodes(options, "Master", context);
  if (masters.empty() || !are_shells(nodes, "Node", options, context)) return;
  if (masters.size() > 1) {
    context.issues.add(options.where("Master"),
                       "must name one node, got " + std::to_string(masters.size()));
    return;
  }
  const int master = masters.front();
  if (context.model.nodes().kind(master) == NodeKind::node6) {
    context.issues.add(options.where("Master"), "node '" + context.model.node_name(master) +
                                                    "' is one of a shell; it must be one of a "
                                                    "beam or body");
    return;
  }
  for (int node : nodes) {
    add_named(soft_transition(context.model.nodes(), node, master), type, options, node, context);
  }
}

using Build = void (*)(const std::string& type, const Options& options,
                       model::BuildContext& context);

void add_type(model::BuilderRegistry& registry, Schema schema, Build build) {
  const std::string type = schema.name();
  registry.add(type, std::move(schema),
               [type, build](const Options& options, model::BuildContext& context) {
                 build(type, options, context);
               });
}

}  // namespace

void register_shell_connections(model::BuilderRegistry& registry) {
  add_type(registry,
           pairs_schema("Smooth Connection",
                        "Joins shells whose directors are "
                        "parallel as if they were one."),
           build_smooth);
  add_type(registry,
           pairs_schema("Fold Connection",
                        "Joins shells along a line and keeps "
                        "the angle between their directors.")
               .add(flag("Inextensible",
                         "Holds the lengths of the directors "
                         "as well.")
                        .optional(false)),
           build_fold);
  add_type(registry,
           pairs_schema("Hinge Connection",
                        "Joins the positions of nodes and "
                        "leaves their directors free."),
           build_hinge);
  add_type(registry,
           pairs_schema("Layer Connection",
                        "Joins the upper face of the first shell "
                        "to the lower face of the second."),
           build_layer);
  add_type(registry,
           Schema("Inextensible Director",
                  "Holds the length of the director of a "
                  "shell node.")
               .add(model::node_field()),
           build_inextensible);
  add_type(registry,
           directed_schema("Director Support",
                           "Holds the component of the director of a shell node in one direction.",
                           "Direction", "Direction in space, of any length.", model::node_field()),
           build_director_support);
  add_type(registry,
           Schema("Soft Transition",
                  "Ties shell nodes to a node of a beam or "
                  "body; they may move along their "
                  "directors and change thickness.")
               .add(model::node_field("Node", "Nodes of the shell."))
               .add(model::node_field("Master", "The node of a beam or body.")),
           build_soft);
}

}  // namespace culm::joint
