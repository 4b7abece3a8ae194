/// Air on structures that are described in a frame turning with them.
#pragma once

#include <culm/model/model.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// A sentence for each load of strips on nodes that a rotating frame turns: these stand still in
/// the frame, and strips meet the wind without the speed of the frame.
std::vector<std::string> strips_that_miss_rotation(const model::Model& model);

}  // namespace culm::simulation
