/// From a file to the same validated options on all ranks.
#pragma once

#include <culm/base/options.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/simulation/catalogue.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// Rank 0 reads the deck and its includes, all ranks parse and validate the same text. Throws
/// FileError, InputError or UsageError (an override that is no assignment) on all ranks.
Options read_deck(const parallel::Comm& comm, const Catalogue& catalogue, const std::string& path,
                  const std::vector<std::string>& overrides);

}  // namespace culm::simulation
