#include <culm/load/register_load.hpp>

#include "types.hpp"

namespace culm::load {

void register_loads(model::BuilderRegistry& registry) {
  register_force(registry);
  register_moment(registry);
  register_line_force(registry);
  register_line_moment(registry);
  register_line_load(registry);
  register_field_force(registry);
  register_pressure(registry);
  register_surface_force(registry);
  register_director_force(registry);
  register_gravity(registry);
  register_external(registry);
  register_rotating_frame(registry);
  register_catenary(registry);
  register_spring(registry);
  register_directed_spring(registry);
  register_ground_spring(registry);
  register_directed_ground_spring(registry);
  register_plane_ground_spring(registry);
  register_torsion(registry);
  register_rotation_damper(registry);
}

}  // namespace culm::load
