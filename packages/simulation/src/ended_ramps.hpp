/// Loads that follow `Ramp`, where it is held.
#pragma once

#include <culm/base/options.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// A sentence for an analysis with levels beyond 1, such as a static one, in a deck where nothing
/// but 'Ramp' grows.
std::vector<std::string> levels_beyond_ramp(const Options& deck, const Options& analysis);
/// A sentence where an analysis that goes on from a path holds what follows 'Ramp' between 0 and 1,
/// but begins elsewhere. @param level  where the path ended
std::vector<std::string> ramps_cut_off(const Options& deck, const Options& analysis, double level);

}  // namespace culm::simulation
