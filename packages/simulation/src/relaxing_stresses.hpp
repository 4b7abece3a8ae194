/// Stresses of viscoelastic structures that a history watches.
#pragma once

#include <culm/base/options.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// A sentence for each watched stress in a motion that lacks what branches of 'Relaxation' carry.
std::vector<std::string> stresses_without_branches(const Options& deck, const Options& analysis);

}  // namespace culm::simulation
