/// Where a point of a port is attached.
#pragma once

#include <culm/model/structure.hpp>

namespace culm::port {

/// A material point and where it lies, for reports and pictures.
struct Place {
  model::Marker marker;
  int structure = -1;                                 ///< number in the model
  int cell = -1;                                      ///< number in the structure
  Eigen::Vector2d natural = Eigen::Vector2d::Zero();  ///< xi, eta in the cell
  double distance = 0.0;  ///< from the axis, the mid-surface or the node [m]
  double beyond = 0.0;    ///< how much of it is past an end of a line or the rim of a surface [m]
  /// Length of the fibre through the point over that on the axis, 1 - offset x curvature: below
  /// zero cross-sections overlap.
  double fibre = 1.0;
  int rival = -1;  ///< another structure, or the same one elsewhere, that is about as near
};

}  // namespace culm::port
