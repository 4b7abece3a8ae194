/// The types of contact.
#pragma once

#include <culm/model/build_context.hpp>

namespace culm::contact {

void register_plane_contact(model::BuilderRegistry& registry);     // Plane Contact
void register_cylinder_contact(model::BuilderRegistry& registry);  // Cylinder Contact

}  // namespace culm::contact
