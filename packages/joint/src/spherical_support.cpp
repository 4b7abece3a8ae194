#include <culm/joint/spherical_support.hpp>

#include "supports.hpp"

namespace culm::joint {

model::Constraint spherical_support(const model::NodeTable& nodes, int node, const Vec3& offset) {
  model::Constraint support = support_of(node);
  const Eigen::Matrix3Xd q = model::NodeTable::slots(nodes.reference(), node);
  add_vector_rows(model::attached_point(0, 1, offset), q, support);
  if (offset.isZero(0.0)) support.fix = {node, {0b000111}};
  return support;
}

void register_spherical_support(model::BuilderRegistry& registry) {
  const std::string type = "Spherical Support";
  registry.add(type,
               Schema(type, "Holds a point and leaves all rotations free.")
                   .add(model::node_field())
                   .add(offset_field()),
               [type](const Options& options, model::BuildContext& context) {
                 add_per_node(type, options, context, [&](int node) {
                   return spherical_support(context.model.nodes(), node,
                                            model::vector(options, "Offset"));
                 });
               });
}

}  // namespace culm::joint
