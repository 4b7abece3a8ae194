#include <culm/joint/angular_velocity.hpp>
#include <culm/joint/cylindrical_joint.hpp>
#include <culm/joint/joint_angle.hpp>
#include <culm/joint/planar_support.hpp>
#include <culm/joint/prismatic_joint.hpp>
#include <culm/joint/register_joint.hpp>
#include <culm/joint/revolute_joint.hpp>
#include <culm/joint/revolute_support.hpp>
#include <culm/joint/rigid_connection.hpp>
#include <culm/joint/rigid_support.hpp>
#include <culm/joint/rotation.hpp>
#include <culm/joint/shell_connection.hpp>
#include <culm/joint/simple_support.hpp>
#include <culm/joint/simple_support_local.hpp>
#include <culm/joint/spherical_joint.hpp>
#include <culm/joint/spherical_support.hpp>
#include <culm/joint/universal_joint.hpp>
#include <culm/joint/weld.hpp>

namespace culm::joint {

void register_joints(model::BuilderRegistry& registry) {
  register_rigid_support(registry);
  register_spherical_support(registry);
  register_simple_support(registry);
  register_simple_support_local(registry);
  register_revolute_support(registry);
  register_planar_support(registry);
  register_rotation(registry);
  register_angular_velocity(registry);
  register_rigid_connection(registry);
  register_spherical_joint(registry);
  register_revolute_joint(registry);
  register_cylindrical_joint(registry);
  register_prismatic_joint(registry);
  register_universal_joint(registry);
  register_weld(registry);
  register_joint_angle(registry);
  register_shell_connections(registry);
}

}  // namespace culm::joint
