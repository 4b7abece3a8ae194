/// The list "Imperfections" of the deck.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/model/imperfection.hpp>

namespace culm::simulation {

Schema imperfections_schema();

/// Shapes of other runs, scaled. Throws InputError and FileError.
model::Imperfection read_imperfections(const Options& list);

}  // namespace culm::simulation
