#include <culm/load/register_load.hpp>

#include "types.hpp"

namespace culm::load {

void register_loads(model::BuilderRegistry& registry) {
  register_force(registry);
  register_moment(registry);
  register_line_force(registry);
  register_line_moment(registry);
  register_gravity(registry);
}

}  // namespace culm::load
