#include <culm/joint/rigid_connection.hpp>

namespace culm::joint {
namespace {

void build(const Options& options, model::BuildContext& context) {
  const std::vector<int> masters = model::select_nodes(options, "Master", context);
  const std::vector<int> followers = model::select_nodes(options, "Node", context);
  if (masters.empty()) return;
  if (masters.size() > 1) {
    context.issues.add(options.where("Master"),
                       "must name one node, got " + std::to_string(masters.size()));
    return;
  }
  const model::NodeTable& nodes = context.model.nodes();
  if (nodes.kind(masters.front()) == NodeKind::node6) {
    context.issues.add(options.where("Master"),
                       "node '" + context.model.node_name(masters.front()) +
                           "' is one of a shell and has no triad to follow; shells are joined by "
                           "Smooth, Fold, Hinge and Layer Connection");
    return;
  }
  for (int node : followers) {
    if (node == masters.front()) {
      context.issues.add(options.where("Node"),
                         "node '" + context.model.node_name(node) + "' cannot follow itself");
    } else {
      context.model.add_rigid_link(options.name(), node, masters.front());
    }
  }
}

}  // namespace

void register_rigid_connection(model::BuilderRegistry& registry) {
  const std::string type = "Rigid Connection";
  registry.add(type,
               Schema(type, "Makes nodes follow another one as parts of one rigid body.")
                   .add(model::node_field("Node", "Nodes that follow."))
                   .add(model::node_field("Master", "The node that they follow.")),
               build);
}

}  // namespace culm::joint
