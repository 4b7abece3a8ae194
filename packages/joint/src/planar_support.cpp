#include <culm/joint/planar_support.hpp>

#include "supports.hpp"

namespace culm::joint {

model::Constraint planar_support(const model::NodeTable& nodes, int node, const Vec3& normal) {
  model::Constraint support = support_of(node);
  const Eigen::Matrix3Xd q = model::NodeTable::slots(nodes.reference(), node);
  support.rows = {model::linear_row(normal, model::attached_point(0, 1, Vec3::Zero()), q)};
  add_axis_rows(normal, q, support);
  if (const auto axis = coordinate_axis(normal)) {
    support.fix = {node, rotations_across(*axis).set(*axis)};
  }
  return support;
}

void register_planar_support(model::BuilderRegistry& registry) {
  const std::string type = "Planar Support";
  registry.add(type,
               directed_schema(type, "Leaves motion in a plane and rotation about its normal.",
                               "Normal", "Normal of the plane, of any length."),
               [type](const Options& options, model::BuildContext& context) {
                 add_per_node(type, options, context, [&](int node) {
                   return planar_support(context.model.nodes(), node,
                                         read_direction(options, "Normal"));
                 });
               });
}

}  // namespace culm::joint
