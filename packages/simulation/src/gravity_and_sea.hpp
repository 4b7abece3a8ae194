/// Weight and buoyancy of one deck.
#pragma once

#include <culm/base/options.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// A sentence for each load of type 'Gravity', active in an analysis, that pulls another way than
/// down in a sea of the deck, or by more than a hundredth more or less than the sea's own gravity:
/// weight and buoyancy would not belong to one world.
std::vector<std::string> weights_that_miss_seas(const Options& deck, const Options& analysis);

}  // namespace culm::simulation
