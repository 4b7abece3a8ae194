/// Couplings heard again from their records.
#pragma once

#include <culm/parallel/comm.hpp>
#include <culm/simulation/catalogue.hpp>
#include <culm/simulation/read_deck.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace culm::simulation {

/// Overrides by which a deck without a list "Coupling" gets one for the replay of a record, or of
/// all records of a folder; none where it has one. Collective; throws what read_deck throws, and
/// FileError for what is no record.
std::vector<std::string> replay_settings(const parallel::Comm& comm, const Catalogue& catalogue,
                                         const DeckSource& source,
                                         const std::filesystem::path& records);

/// Asks a partner at an address all that a record says that it was asked. Collective; throws
/// PartnerError where it fails, PromiseBroken where it answers differently by more than rounding.
/// @param address  as of coupling::listen, or 'mpi:RANK'
/// @return what was compared, in a sentence
std::string replay_to_partner(const parallel::Comm& comm, const std::filesystem::path& record,
                              const std::string& address, double patience);

}  // namespace culm::simulation
