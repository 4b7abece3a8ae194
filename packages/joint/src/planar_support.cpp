#include <culm/joint/planar_support.hpp>

#include "supports.hpp"

namespace culm::joint {

model::Constraint planar_support(const Anchor& anchor, const Vec3& normal) {
  model::Constraint support = support_of(anchor);
  support.rows = {model::linear_row(normal, anchor.point(), anchor.reference())};
  add_axis_rows(normal, anchor, support);
  if (const auto axis = coordinate_axis(normal); axis && is_node(anchor, Vec3::Zero())) {
    support.fix = {anchor.node(), rotations_across(*axis).set(*axis)};
  }
  return support;
}

void register_planar_support(model::BuilderRegistry& registry) {
  const std::string type = "Planar Support";
  registry.add(type,
               directed_schema(type, "Leaves motion in a plane and rotation about its normal.",
                               "Normal", "Normal of the plane, of any length."),
               [type](const Options& options, model::BuildContext& context) {
                 add_per_anchor(type, options, context, [&](const Anchor& anchor) {
                   return planar_support(anchor, read_direction(options, "Normal"));
                 });
               });
}

}  // namespace culm::joint
