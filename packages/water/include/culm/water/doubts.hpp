/// What loads of a sea leave out that the sea has.
#pragma once

#include <culm/model/model.hpp>

#include <string>
#include <vector>

namespace culm::water {

/// Of loads 'Potential Flow': a current that no load on the body sees, and a level of still water
/// that files about a node elsewhere do not know. Sentences without full stop.
std::vector<std::string> left_out_of_bodies(const model::Model& model);

}  // namespace culm::water
