#include <culm/joint/spherical_joint.hpp>

namespace culm::joint {

model::Constraint spherical_joint(const MarkerPair& pair) {
  model::Constraint joint = pair.joint();
  pair.add_point_rows(joint);
  return joint;
}

void register_spherical_joint(model::BuilderRegistry& registry) {
  register_pair_joint(registry, "Spherical Joint",
                      "Joins a point of two nodes and leaves all rotations free.",
                      &spherical_joint);
}

}  // namespace culm::joint
