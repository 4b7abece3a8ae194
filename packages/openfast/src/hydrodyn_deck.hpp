/// Loads of a deck from HydroDyn's file.
#pragma once

#include <culm/openfast/deck_writer.hpp>
#include <culm/openfast/hydrodyn.hpp>
#include <culm/openfast/subdyn.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace culm::openfast {

/// Potential flow about a body whose node is at the origin, and the forces that the file adds to
/// it, inside an open list Loads. @param folder  of the deck, from which it names files
void write_hull(const HydroDyn& hydro, const std::string& body, const std::filesystem::path& folder,
                DeckWriter& deck, Report& report);

/// What fills the members, as a rigid body at the origin.
struct Ballast {
  double mass = 0.0;            ///< [kg]
  Vec3 centre = Vec3::Zero();   ///< [m]
  Mat3 inertia = Mat3::Zero();  ///< about its centre [kg m^2]
};
Ballast ballast_of(const HydroDyn& hydro);

/// A Morison load for each member, on such a body, inside an open list Loads; of members that are
/// left to potential flow their drag. @param floats  whether what fills them is a body of its own
void write_members(const HydroDyn& hydro, const std::string& body, bool floats, DeckWriter& deck,
                   Report& report);

/// The same on the beams of SubDyn along which the members lie, in as many pieces; what lies along
/// none is told. @return names of the loads
std::vector<std::string> write_members(const HydroDyn& hydro, const SubDyn& sub, DeckWriter& deck,
                                       Report& report);

/// The members on a body that is held, in their sea.
std::string write_deck(const HydroDyn& hydro, Report& report);

}  // namespace culm::openfast
