/// Velocities and accelerations of ports in steps that are open.
#pragma once

#include <culm/base/options.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// A sentence where a program or partner sees them otherwise than the scheme of an analysis has
/// them.
std::vector<std::string> rates_of_another_scheme(const Options& analysis);

}  // namespace culm::simulation
