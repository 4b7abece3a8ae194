/// The quantity of contact.
#pragma once

#include <culm/simulation/quantity.hpp>

namespace culm::simulation {

/// Contact.
void register_contact_quantity(QuantityRegistry& registry);

}  // namespace culm::simulation
