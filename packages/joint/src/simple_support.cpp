#include <culm/joint/simple_support.hpp>

#include "supports.hpp"

namespace culm::joint {

model::Constraint simple_support(const model::NodeTable& nodes, int node, const Vec3& n,
                                 const Vec3& offset, const Prescribed& motion) {
  model::Constraint support = support_of(node);
  const Eigen::Matrix3Xd q = model::NodeTable::slots(nodes.reference(), node);
  support.rows = {model::linear_row(n, model::attached_point(0, 1, offset), q)};
  if (motion.moves()) {
    drive_constant(motion, support);
  } else if (const auto axis = coordinate_axis(n); axis && offset.isZero(0.0)) {
    support.fix = {node, std::bitset<6>().set(*axis)};
  }
  return support;
}

void register_simple_support(model::BuilderRegistry& registry) {
  const std::string type = "Simple Support";
  Schema schema = directed_schema(type, "Holds a point in one direction fixed in space.",
                                  "Direction", "Direction in space, of any length.");
  schema.add(offset_field());
  add_motion("Translation", "m", "Motion along the direction at function value 1.", schema);
  registry.add(type, schema, [type](const Options& options, model::BuildContext& context) {
    const auto motion = read_motion(options, "Translation", context);
    if (!motion) return;
    add_per_node(type, options, context, [&](int node) {
      return simple_support(context.model.nodes(), node, read_direction(options, "Direction"),
                            model::vector(options, "Offset"), *motion);
    });
  });
}

}  // namespace culm::joint
