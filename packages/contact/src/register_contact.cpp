#include <culm/contact/register_contact.hpp>

#include "types.hpp"

namespace culm::contact {

void register_contact(model::BuilderRegistry& registry) {
#define CULM_REGISTER(type) register_##type(registry);
  CULM_CONTACTS(CULM_REGISTER)
#undef CULM_REGISTER
}

}  // namespace culm::contact
