#include <culm/contact/register_contact.hpp>

#include "types.hpp"

namespace culm::contact {

void register_contact(model::BuilderRegistry& registry) {
  register_plane_contact(registry);
  register_cylinder_contact(registry);
}

}  // namespace culm::contact
