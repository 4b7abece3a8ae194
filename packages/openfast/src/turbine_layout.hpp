/// Where the parts of a turbine are.
#pragma once

#include <culm/openfast/elastodyn.hpp>

#include "blade_lists.hpp"

#include <vector>

namespace culm::openfast {

/// Places in the frame of the deck: x downwind, z up, the origin at the height from which the files
/// count. The nacelle stands at the angle about z that is fixed, or neutral.
struct TurbineLayout {
  Vec3 base;     ///< of the tower
  Vec3 top;      ///< of the tower
  Mat3 nacelle;  ///< columns: its axes, x downwind if it is not yawed
  Vec3 shaft;    ///< direction, downwind
  Vec3 place;    ///< of the shaft at the yaw axis
  Vec3 apex;
  std::vector<Placement> roots;  ///< of the blades

  explicit TurbineLayout(const ElastoDyn& turbine);
};

/// Inertia of nacelle, hub and rigid blades about the yaw axis [kg m^2].
double yaw_inertia(const ElastoDyn& turbine, const TurbineLayout& layout);

}  // namespace culm::openfast
