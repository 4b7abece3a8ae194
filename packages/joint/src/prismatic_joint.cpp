#include <culm/joint/prismatic_joint.hpp>
#include <culm/math/rotation.hpp>

#include <Eigen/Geometry>

namespace culm::joint {

model::Constraint prismatic_joint(const MarkerPair& pair, const Vec3& axis) {
  model::Constraint joint = pair.joint();
  pair.add_line_rows(axis, joint);
  pair.add_parallel_rows(axis, joint);
  const Vec3 across = any_normal(axis);
  pair.add_angle_row(across, axis.cross(across), joint);
  return joint;
}

void register_prismatic_joint(model::BuilderRegistry& registry) {
  register_axis_joint(registry, "Prismatic Joint", "Leaves the translation along one axis.",
                      &prismatic_joint);
}

}  // namespace culm::joint
