/// Structures that gravity does not pull.
#pragma once

#include <culm/base/options.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// A sentence where gravity acts on beams and shells whose sections or materials have no mass, in a
/// deck without masses on nodes: a density may be missing.
std::vector<std::string> weightless_structures(const Options& deck);

}  // namespace culm::simulation
