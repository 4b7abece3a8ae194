/// Pieces of slender members as water sees them.
#pragma once

#include <culm/model/structure.hpp>

#include <array>

namespace culm::water {

/// A circular section of a member, and how water acts on it.
struct WetSection {
  double diameter = 0.0;          ///< outer, with growth [m]
  double flooded_diameter = 0.0;  ///< inner, of what is open to the water; 0: none [m]
  double drag = 0.0;              ///< coefficient of the drag across the axis [-]
  double added_mass = 0.0;  ///< mass of water that moves along across the axis, over rho A [-]
  double axial_drag = 0.0;  ///< of the friction along the axis, over its surface [-]
  double axial_added_mass = 0.0;  ///< along the axis [-]
  double growth_mass = 0.0;       ///< of what has grown on it, per length [kg/m]
};

/// What is at an end of a segment.
enum class Face {
  none,  ///< the next segment, with which it has no face
  wet,   ///< water
  dry,   ///< something else: soil, another member
};

/// A straight piece between two material points.
struct Segment {
  std::array<model::Marker, 2> ends;  ///< in which a node may stand more than once
  double length = 0.0;                ///< of the reference [m]
  std::array<WetSection, 2> sections;
  std::array<Face, 2> faces = {Face::none, Face::none};
  std::array<bool, 2> goes_on = {false, false};   ///< the member does, beyond what the load acts on
  std::array<bool, 2> has_next = {false, false};  ///< there another load of the water acts on it
};

/// What holds for all segments of a load.
struct MorisonModel {
  bool buoyancy = true;  ///< whether the pressure of the water acts on them
  /// Coefficients of the drag of the first and the last face, where they are wet [-].
  std::array<double, 2> end_drag = {0.0, 0.0};
  /// Water that moves with them, over that in a half sphere [-].
  std::array<double, 2> end_added_mass = {0.0, 0.0};
  bool pull = true;  ///< without `buoyancy`: whether waves pull across, by their acceleration
};

}  // namespace culm::water
