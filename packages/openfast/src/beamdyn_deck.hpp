/// Decks of a single blade.
#pragma once

#include <culm/openfast/beamdyn.hpp>
#include <culm/openfast/report.hpp>

#include <string>

namespace culm::openfast {

/// A blade clamped at its root, held horizontally, under its own weight.
std::string write_deck(const BeamDyn& beam, Report& report);
/// What a driver asks for.
std::string write_deck(const BeamDynDriver& driver, Report& report);

}  // namespace culm::openfast
