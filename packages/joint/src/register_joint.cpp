#include <culm/joint/register_joint.hpp>

namespace culm::joint {

// Every type, one line each: NAME stands for register_NAME.
#define CULM_JOINTS(TYPE)    \
  TYPE(rigid_support)        \
  TYPE(spherical_support)    \
  TYPE(simple_support)       \
  TYPE(simple_support_local) \
  TYPE(revolute_support)     \
  TYPE(planar_support)       \
  TYPE(rotation)             \
  TYPE(angular_velocity)     \
  TYPE(rigid_connection)     \
  TYPE(spherical_joint)      \
  TYPE(revolute_joint)       \
  TYPE(cylindrical_joint)    \
  TYPE(prismatic_joint)      \
  TYPE(universal_joint)      \
  TYPE(weld)                 \
  TYPE(joint_angle)          \
  TYPE(shell_connections)

#define CULM_DECLARE(type) void register_##type(model::BuilderRegistry& registry);
CULM_JOINTS(CULM_DECLARE)
#undef CULM_DECLARE

void register_joints(model::BuilderRegistry& registry) {
#define CULM_REGISTER(type) register_##type(registry);
  CULM_JOINTS(CULM_REGISTER)
#undef CULM_REGISTER
}

}  // namespace culm::joint
