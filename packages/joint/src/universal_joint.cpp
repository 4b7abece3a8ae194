#include <culm/joint/universal_joint.hpp>

#include <cmath>

namespace culm::joint {

model::Constraint universal_joint(const MarkerPair& pair, const Vec3& first_axis,
                                  const Vec3& second_axis) {
  model::Constraint joint = pair.joint();
  pair.add_point_rows(joint);
  pair.add_angle_row(first_axis, second_axis, joint);
  return joint;
}

void register_universal_joint(model::BuilderRegistry& registry) {
  const std::string type = "Universal Joint";
  Schema schema = pair_schema(type, "Joins a point of two nodes by two crossed hinges.");
  add_direction("First Axis", "Hinge axis fixed to the first node, in the reference.", schema);
  add_direction("Second Axis", "Hinge axis fixed to the second node, normal to the first.", schema);
  schema.check([](const Options& options, InputIssues& issues) {
    const Vec3 a = model::vector(options, "First Axis").normalized();
    const Vec3 b = model::vector(options, "Second Axis").normalized();
    if (std::abs(a.dot(b)) > 1e-6) {
      issues.add(options.where("Second Axis"), "must be normal to First Axis");
    }
  });
  registry.add(type, schema, [type](const Options& options, model::BuildContext& context) {
    add_joint(type, options, context, [&](const MarkerPair& pair) {
      return universal_joint(pair, model::vector(options, "First Axis").normalized(),
                             model::vector(options, "Second Axis").normalized());
    });
  });
}

}  // namespace culm::joint
