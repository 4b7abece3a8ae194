/// The load of the sea on one member of HydroDyn.
#pragma once

#include <culm/openfast/deck_writer.hpp>
#include <culm/openfast/hydrodyn.hpp>
#include <culm/openfast/report.hpp>

#include <array>
#include <string>

namespace culm::openfast {

/// Parts of a length below it are rounding of files.
constexpr double least_share = 1e-4;

/// What carries a member: a body with its node at the origin, or a beam along the member.
struct MemberCarrier {
  std::string body = {};
  std::string beam = {};
  std::array<double, 2> of_member = {0.0, 1.0};  ///< the part of the member's length on the beam
  std::array<double, 2> of_beam = {0.0, 1.0};    ///< the same part of the beam's, rising
  bool floats = false;                           ///< what fills a member is a body of its own
};

/// Writes its Morison load inside an open list Loads; of a member that is left to potential flow
/// the drag. @return whether there is anything above the bed and of any length
bool write_member(const HydroDyn& hydro, const HydroMember& member, const MemberCarrier& carrier,
                  const std::string& name, DeckWriter& deck, Report& report);

}  // namespace culm::openfast
