#include <culm/joint/weld.hpp>

namespace culm::joint {

model::Constraint weld(const MarkerPair& pair) {
  model::Constraint joint = pair.joint();
  pair.add_point_rows(joint);
  // the cyclic choice keeps the three gradients independent
  for (int i = 0; i < 3; ++i) pair.add_angle_row(Vec3::Unit(i), Vec3::Unit((i + 1) % 3), joint);
  return joint;
}

void register_weld(model::BuilderRegistry& registry) {
  register_pair_joint(
      registry, "Weld",
      "Joins two nodes rigidly by equations; Rigid Connection does so by elimination.", &weld);
}

}  // namespace culm::joint
