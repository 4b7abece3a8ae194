/// From the lists of a deck to a model.
#pragma once

#include <culm/base/log.hpp>
#include <culm/simulation/catalogue.hpp>
#include <culm/simulation/result_files.hpp>

namespace culm::simulation {

/// Fills the model with all that the deck lists, and freezes it. Throws InputError with all
/// mistakes. @return the quantities that the history watches
std::vector<WatchedQuantity> build_model(const Catalogue& catalogue, const Options& deck,
                                         const Log& log, model::Model& model);

}  // namespace culm::simulation
