#include <culm/joint/rigid_support.hpp>

#include "supports.hpp"

namespace culm::joint {

model::Constraint rigid_support(const model::NodeTable& nodes, int node) {
  model::Constraint support = support_of(node);
  const Eigen::Matrix3Xd q = model::NodeTable::slots(nodes.reference(), node);
  // x - x0 and d_i - d_i0
  for (std::size_t slot = 0; slot < 4; ++slot) {
    model::SlotSum alpha(4, 0.0);
    alpha[slot] = 1.0;
    add_vector_rows(alpha, q, support);
  }
  support.fix = {node, {0b111111}};
  support.replaces_internal = node;
  return support;
}

void register_rigid_support(model::BuilderRegistry& registry) {
  const std::string type = "Rigid Support";
  registry.add(type, Schema(type, "Holds position and directors.").add(model::node_field()),
               [type](const Options& options, model::BuildContext& context) {
                 add_per_node(type, options, context,
                              [&](int node) { return rigid_support(context.model.nodes(), node); });
               });
}

}  // namespace culm::joint
