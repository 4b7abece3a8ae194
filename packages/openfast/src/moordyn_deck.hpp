/// Mooring lines of a deck from MoorDyn's file.
#pragma once

#include <culm/openfast/deck_writer.hpp>
#include <culm/openfast/moordyn.hpp>

#include <string>

namespace culm::openfast {

/// Whether a line leads from a fixed point to the vessel; others are not in the deck.
bool moors_the_vessel(const MoorDyn& moorings, const MooringLine& line);

/// A Catenary for each line between a fixed point and a body whose node is at the reference point
/// of the vessel, inside an open list Loads; names of those that are there.
std::vector<std::string> write_lines(const MoorDyn& moorings, const std::string& body,
                                     DeckWriter& deck, Report& report);

/// The lines on a body that is held.
std::string write_deck(const MoorDyn& moorings, Report& report);

}  // namespace culm::openfast
