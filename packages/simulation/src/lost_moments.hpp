/// Moments that shells do not take.
#pragma once

#include <culm/model/model.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// A sentence for each load by moments of which a notable part is along the director of a shell.
std::vector<std::string> moments_that_are_not_carried(const model::Model& model);

}  // namespace culm::simulation
