#include <culm/joint/triad_nodes.hpp>

namespace culm::joint {

bool have_triads(const std::vector<int>& nodes, const std::string& parameter,
                 const Options& options, model::BuildContext& context) {
  for (int node : nodes) {
    if (context.model.nodes().kind(node) == NodeKind::node12) continue;
    context.issues.add(options.where(parameter),
                       "node '" + context.model.node_name(node) +
                           "' is one of a shell and has no triad; shells take Smooth, Fold, Hinge "
                           "and Layer Connection, Rigid Connection and Soft Transition");
    return false;
  }
  return true;
}

}  // namespace culm::joint
