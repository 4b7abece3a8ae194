/// Lists of a deck that describe a sea.
#pragma once

#include <culm/openfast/deck_writer.hpp>
#include <culm/openfast/seastate.hpp>

#include <string>

namespace culm::openfast {

/// The name of the sea in a deck.
inline constexpr const char* sea_name = "sea";

/// The sea, an entry of the list Flows.
void write_sea(const SeaState& sea, DeckWriter& deck);
/// The list with nothing else.
void write_flows(const SeaState& sea, DeckWriter& deck);

/// A body without motion that carries what acts in the sea.
void write_held_body(const std::string& name, const std::string& constraint, DeckWriter& deck);

/// A deck of the sea alone, with a thin pole that shows it.
std::string write_deck(const SeaState& sea, Report& report);

}  // namespace culm::openfast
