/// What tells a turn that is prescribed from those that meet the same equations.
#pragma once

#include <culm/joint/anchor.hpp>
#include <culm/joint/marker_pair.hpp>
#include <culm/joint/prescribed.hpp>

namespace culm::joint {

/// How far a rotation is from one by `angle` about a unit axis [rad], in [0, pi]: the difference of
/// the angles about the axis, whatever turns the axis itself, by less than a right angle; beyond,
/// 0.
double off_about(const Vec3& axis, double angle, const Mat3& rotation);

/// Of a point that turns about an axis in space and is free to turn about others.
model::Constraint::Turn turn_about(const Anchor& anchor, const Vec3& axis,
                                   const Prescribed& motion);
/// Of the second of two points against the first.
model::Constraint::Turn turn_between(const MarkerPair& pair, const Vec3& axis,
                                     const Prescribed& motion);
/// Of a point that has no other rotation than this one.
model::Constraint::Turn turn_of_all(const Anchor& anchor, const Vec3& axis,
                                    const Prescribed& motion);

}  // namespace culm::joint
