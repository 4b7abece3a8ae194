#pragma once

#include <culm/joint/marker_pair.hpp>

namespace culm::joint {

/// Two crossed hinges: joins a point and keeps `first_axis` of the first node normal to
/// `second_axis` of the second one: four rows. @source formulation 2.2
/// @pre the axes are normal to each other
model::Constraint universal_joint(const MarkerPair& pair, const Vec3& first_axis,
                                  const Vec3& second_axis);

void register_universal_joint(model::BuilderRegistry& registry);

}  // namespace culm::joint
