/// The types of contact.
#pragma once

#include <culm/model/build_context.hpp>

namespace culm::contact {

/// Every type, one line each: NAME stands for register_NAME.
#define CULM_CONTACTS(TYPE)                  \
  TYPE(beam_contact)     /* Beam Contact */  \
  TYPE(plane_contact)    /* Plane Contact */ \
  TYPE(cylinder_contact) /* Cylinder Contact */

#define CULM_DECLARE(type) void register_##type(model::BuilderRegistry& registry);
CULM_CONTACTS(CULM_DECLARE)
#undef CULM_DECLARE

}  // namespace culm::contact
