#include <culm/joint/cylindrical_joint.hpp>

namespace culm::joint {

model::Constraint cylindrical_joint(const MarkerPair& pair, const Vec3& axis) {
  model::Constraint joint = pair.joint();
  pair.add_line_rows(axis, joint);
  pair.add_parallel_rows(axis, joint);
  return joint;
}

void register_cylindrical_joint(model::BuilderRegistry& registry) {
  register_axis_joint(registry, "Cylindrical Joint",
                      "Leaves the translation along one axis and the rotation about it.",
                      &cylindrical_joint);
}

}  // namespace culm::joint
