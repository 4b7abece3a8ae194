#pragma once

#include <culm/joint/anchor.hpp>
#include <culm/joint/prescribed.hpp>
#include <culm/model/build_context.hpp>

#include <optional>

namespace culm::joint {

/// Where a rigid support goes: a translation, and a rotation about an axis through a point.
struct SupportMotion {
  Translation translation;
  Vec3 axis = Vec3::UnitZ();  ///< unit length, fixed in space
  Prescribed angle;           ///< [rad]
  std::optional<Vec3> about =
      {};  ///< a point on the axis in the reference [m]; the held one if absent

  bool moves() const { return translation.moves() || angle.moves(); }
};

/// Holds a node altogether: x - x0 and d_i - d_i0, twelve linear rows that imply the internal ones.
/// Eliminated. Where the support moves, or the point lies between nodes, six rows do the same
/// beside the internal ones, with R(t) of the motion:
///   x - x0 - u(t) - (R - 1)(x0 - a)      R e_i . u(e_j) = 0, (i, j) = (1, 2), (2, 3), (3, 1),
/// a being the point on the axis.
/// @source formulation 2.2 "rigidsupport", "weld", 2.7
model::Constraint rigid_support(const Anchor& anchor, const SupportMotion& motion = {});

void register_rigid_support(model::BuilderRegistry& registry);

}  // namespace culm::joint
