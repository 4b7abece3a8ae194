/// Which slots have mass.
#pragma once

#include <culm/model/model.hpp>

#include <vector>

namespace culm::model {

/// Whether any mass belongs to a slot, for the four slots of all nodes. Slots without, such as the
/// d3 of a straight beam, have no momentum and no equation of motion of their own. Known of the
/// nodes of this rank, and of all until batches forget the items of others.
std::vector<bool> slots_with_mass(const Model& model);

}  // namespace culm::model
