#include <culm/joint/simple_support_local.hpp>

#include "supports.hpp"

namespace culm::joint {

model::Constraint simple_support_local(const model::NodeTable& nodes, int node, const Vec3& n,
                                       const Prescribed& motion) {
  model::Constraint support = support_of(node);
  const Eigen::Matrix3Xd q = model::NodeTable::slots(nodes.reference(), node);
  const Vec3 nu = q.rightCols<3>().transpose() * n;
  support.rows = {model::product_row(model::attached_vector(0, 1, nu),
                                     model::attached_point(0, 1, Vec3::Zero()), q, q.col(0))};
  if (motion.moves()) drive_constant(motion, support);
  return support;
}

void register_simple_support_local(model::BuilderRegistry& registry) {
  const std::string type = "Simple Support Local";
  Schema schema = directed_schema(type, "Holds a node in one direction that turns with it.",
                                  "Direction", "Direction in the reference, of any length.");
  add_motion("Translation", "m", "Motion along the direction at function value 1.", schema);
  registry.add(type, schema, [type](const Options& options, model::BuildContext& context) {
    const auto motion = read_motion(options, "Translation", context);
    if (!motion) return;
    add_per_node(type, options, context, [&](int node) {
      return simple_support_local(context.model.nodes(), node, read_direction(options, "Direction"),
                                  *motion);
    });
  });
}

}  // namespace culm::joint
