#include <culm/math/rotation.hpp>
#include <culm/model/initial_motion.hpp>

#include <algorithm>
#include <set>

namespace culm::model {
namespace {

// Amounts that are left out are zero.
void refuse_rest(const std::string& one, const std::string& other, const Options& options,
                 InputIssues& issues) {
  if (options.given(one) || options.given(other)) return;
  issues.add(options.where(), "moves nothing: give '" + one + "' or '" + other + "'");
}

// Parameter "About", or the first of the nodes.
Vec3 centre_of(const Options& options, const std::vector<int>& nodes, const Model& model) {
  if (options.has("About")) return vector(options, "About");
  return NodeTable::slots(model.nodes().reference(), nodes.front()).col(0);
}

// The nodes that a parameter names, and the bodies of rigid shells that are named whole: what
// follows does not move by itself.
std::vector<int> select_moving_nodes(const Options& options, BuildContext& context) {
  std::vector<int> nodes = select_nodes(options, "Node", context);
  if (nodes.empty()) return nodes;
  const std::set<int> named(nodes.begin(), nodes.end());
  for (const Structure& structure : context.model.structures()) {
    if (!structure.body || named.contains(*structure.body)) continue;
    const bool is_whole = std::all_of(structure.nodes.begin(), structure.nodes.end(),
                                      [&](int node) { return named.contains(node); });
    if (is_whole) nodes.push_back(*structure.body);
  }
  return nodes;
}

void build_velocity(const Options& options, BuildContext& context) {
  const std::vector<int> nodes = select_moving_nodes(options, context);
  if (nodes.empty()) return;
  const Vec3 about = centre_of(options, nodes, context.model);
  for (int node : nodes) {
    context.model.add_initial_velocity(
        {node, vector(options, "Velocity"), vector(options, "Angular Velocity"), about});
  }
}

void build_displacement(const Options& options, BuildContext& context) {
  const std::vector<int> nodes = select_moving_nodes(options, context);
  if (nodes.empty()) return;
  const Vec3 about = centre_of(options, nodes, context.model);
  const Vec3 rotation = options.number("Angle") * vector(options, "Axis").normalized();
  for (int node : nodes) {
    context.model.add_initial_displacement(
        {options.where(), node, vector(options, "Translation"), rotation, about});
  }
}

}  // namespace

void register_initial_motions(BuilderRegistry& registry) {
  registry.add(
      "Velocity",
      Schema("Velocity", "Nodes start with the velocity of one rigid motion.")
          .add(node_field("Node", "Nodes that start so: a structure, a set or a node."))
          .add(vector_field("Velocity", "m/s", "Translation.").optional({0.0, 0.0, 0.0}))
          .add(vector_field("Angular Velocity", "rad/s", "Rotation.").optional({0.0, 0.0, 0.0}))
          .add(vector_field("About", "m",
                            "Point in space that only translates; where the first of the nodes "
                            "is in the reference if absent.")
                   .optional())
          .check([](const Options& options, InputIssues& issues) {
            refuse_rest("Velocity", "Angular Velocity", options, issues);
          }),
      build_velocity);
  registry.add(
      "Displacement",
      Schema("Displacement",
             "Nodes start displaced by one rigid motion: a rotation about a point, then a "
             "translation. What it strains or takes out of joints is seen as it is: joints are "
             "closed again with the least motion of mass, supports are not left.")
          .add(node_field("Node", "Nodes that start so: a structure, a set or a node."))
          .add(vector_field("Translation", "m", "Translation.").optional({0.0, 0.0, 0.0}))
          .add(vector_field("Axis", "1", "Axis of the rotation, of any length.")
                   .optional({0.0, 0.0, 1.0}))
          .add(number("Angle", "rad", "Angle of the rotation.").optional(0.0))
          .add(
              vector_field("About", "m",
                           "Point on the axis, in the reference; the first of the nodes if absent.")
                  .optional())
          .check([](const Options& options, InputIssues& issues) {
            if (vector(options, "Axis").isZero(0.0)) {
              issues.add(options.where("Axis"), "must not be zero");
            }
            refuse_rest("Translation", "Angle", options, issues);
          }),
      build_displacement);
}

}  // namespace culm::model
