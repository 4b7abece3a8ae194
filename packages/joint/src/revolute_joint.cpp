#include <culm/joint/revolute_joint.hpp>

namespace culm::joint {

model::Constraint revolute_joint(const MarkerPair& pair, const Vec3& axis) {
  model::Constraint joint = pair.joint();
  pair.add_point_rows(joint);
  pair.add_parallel_rows(axis, joint);
  return joint;
}

void register_revolute_joint(model::BuilderRegistry& registry) {
  register_axis_joint(registry, "Revolute Joint",
                      "Joins a point of two nodes and leaves the rotation about one axis.",
                      &revolute_joint);
}

}  // namespace culm::joint
