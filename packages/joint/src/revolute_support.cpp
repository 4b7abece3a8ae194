#include <culm/joint/revolute_support.hpp>

#include "supports.hpp"

namespace culm::joint {

model::Constraint revolute_support(const model::NodeTable& nodes, int node, const Vec3& axis,
                                   const Vec3& offset) {
  model::Constraint support = support_of(node);
  const Eigen::Matrix3Xd q = model::NodeTable::slots(nodes.reference(), node);
  add_vector_rows(model::attached_point(0, 1, offset), q, support);
  add_axis_rows(axis, q, support);
  if (const auto i = coordinate_axis(axis); i && offset.isZero(0.0)) {
    support.fix = {node, rotations_across(*i) | std::bitset<6>(0b000111)};
  }
  return support;
}

void register_revolute_support(model::BuilderRegistry& registry) {
  const std::string type = "Revolute Support";
  Schema schema = directed_schema(type, "Holds a point and leaves the rotation about one axis.",
                                  "Axis", "Axis that stays free, of any length.");
  schema.add(offset_field());
  registry.add(type, schema, [type](const Options& options, model::BuildContext& context) {
    add_per_node(type, options, context, [&](int node) {
      return revolute_support(context.model.nodes(), node, read_direction(options, "Axis"),
                              model::vector(options, "Offset"));
    });
  });
}

}  // namespace culm::joint
