/// The list "Coupling" of a deck.
#pragma once

#include <culm/base/registry.hpp>
#include <culm/base/schema.hpp>
#include <culm/coupling/partner.hpp>

#include <memory>

namespace culm::coupling {

/// Types of the list "Coupling/Partners".
using PartnerRegistry = Registry<std::unique_ptr<Partner>>;

void register_partners(PartnerRegistry& registry);

/// The list "Coupling": scheme, tolerance, window, partners.
Schema coupling_schema(const PartnerRegistry& partners);

}  // namespace culm::coupling
