/// From a file to the same validated options on all ranks.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/snapshot.hpp>
#include <culm/deck/deck.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/simulation/catalogue.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// A deck as it was read: its file, its includes, and what the command line changes.
struct DeckSource {
  std::vector<deck::DeckText> texts;
  std::vector<std::string> overrides;

  /// With absolute names, so that the deck can be read again from another folder.
  void save(Snapshot& snapshot) const;
  /// Throws FileError if there is no deck in it.
  static DeckSource restore(const Snapshot& snapshot);
};

/// Rank 0 reads the deck and its includes, all ranks get the same texts. Throws FileError on all
/// ranks.
DeckSource read_source(const parallel::Comm& comm, const std::string& path,
                       std::vector<std::string> overrides);

/// Parses and validates. Throws InputError or UsageError (an override that is no assignment) on all
/// ranks.
Options read_deck(const Catalogue& catalogue, const DeckSource& source);

}  // namespace culm::simulation
