/// Loads of a deck from HydroDyn's file.
#pragma once

#include <culm/openfast/deck_writer.hpp>
#include <culm/openfast/hydrodyn.hpp>
#include <culm/openfast/subdyn.hpp>

#include <string>
#include <vector>

namespace culm::openfast {

/// A Morison load for each member, on a body whose node is at the origin, inside an open list
/// Loads.
void write_members(const HydroDyn& hydro, const std::string& body, DeckWriter& deck,
                   Report& report);

/// The same on the beams of SubDyn along which the members lie, in as many pieces; what lies along
/// none is told. @return names of the loads
std::vector<std::string> write_members(const HydroDyn& hydro, const SubDyn& sub, DeckWriter& deck,
                                       Report& report);

/// The members on a body that is held, in their sea.
std::string write_deck(const HydroDyn& hydro, Report& report);

}  // namespace culm::openfast
