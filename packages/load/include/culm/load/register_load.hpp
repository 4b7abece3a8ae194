#pragma once

#include <culm/model/build_context.hpp>

namespace culm::load {

/// All types of the deck's list "Loads". Each adds one batch to the model, with a ledger name made
/// of the type and the name in the deck.
void register_loads(model::BuilderRegistry& registry);

}  // namespace culm::load
