/// The load types of contact.
#pragma once

#include <culm/model/build_context.hpp>

namespace culm::contact {

/// Adds "Plane Contact", "Cylinder Contact" and "Beam Contact" to the types of loads.
void register_contact(model::BuilderRegistry& registry);

}  // namespace culm::contact
