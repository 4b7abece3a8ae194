#include <culm/model/initial_motion.hpp>

namespace culm::model {
namespace {

void build_velocity(const Options& options, BuildContext& context) {
  const std::vector<int> nodes = select_nodes(options, "Node", context);
  if (nodes.empty()) return;
  const Vec3 about =
      options.has("About")
          ? vector(options, "About")
          : Vec3(NodeTable::slots(context.model.nodes().reference(), nodes.front()).col(0));
  for (int node : nodes) {
    context.model.add_initial_velocity(
        {node, vector(options, "Velocity"), vector(options, "Angular Velocity"), about});
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
                            "Point that only translates; the first of the nodes if absent.")
                   .optional()),
      build_velocity);
}

}  // namespace culm::model
