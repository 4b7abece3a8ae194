/// Load levels in decks.
#pragma once

#include <culm/base/schema.hpp>

#include <string>

namespace culm::analysis {

/// Declares the numbers "Levels", which rise.
void add_levels(Schema& schema, const std::string& help);

}  // namespace culm::analysis
