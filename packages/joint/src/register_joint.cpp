#include <culm/joint/planar_support.hpp>
#include <culm/joint/register_joint.hpp>
#include <culm/joint/revolute_support.hpp>
#include <culm/joint/rigid_connection.hpp>
#include <culm/joint/rigid_support.hpp>
#include <culm/joint/rotation.hpp>
#include <culm/joint/simple_support.hpp>
#include <culm/joint/simple_support_local.hpp>
#include <culm/joint/spherical_support.hpp>

namespace culm::joint {

void register_joints(model::BuilderRegistry& registry) {
  register_rigid_support(registry);
  register_spherical_support(registry);
  register_simple_support(registry);
  register_simple_support_local(registry);
  register_revolute_support(registry);
  register_planar_support(registry);
  register_rotation(registry);
  register_rigid_connection(registry);
}

}  // namespace culm::joint
