#include <culm/joint/turn.hpp>
#include <culm/math/rotation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace culm::joint {
namespace {

// Attached copies of the axes of space.
using Axes = std::array<model::SlotSum, 3>;

Mat3 rotation_of(const Axes& axes, const Eigen::Matrix3Xd& q) {
  Mat3 rotation;
  for (std::size_t j = 0; j < 3; ++j)
    rotation.col(static_cast<int>(j)) = model::vector_of(axes[j], q);
  return rotation;
}

Axes axes_of(const Anchor& anchor) {
  return {anchor.vector(Vec3::UnitX()), anchor.vector(Vec3::UnitY()), anchor.vector(Vec3::UnitZ())};
}

Axes axes_of(const MarkerPair& pair, int anchor) {
  return {pair.vector(anchor, Vec3::UnitX()), pair.vector(anchor, Vec3::UnitY()),
          pair.vector(anchor, Vec3::UnitZ())};
}

model::Constraint::Turn turn_by(const Prescribed& motion) {
  return {
      [motion](const model::State& state, double theta) { return motion.in_step(state, theta); },
      {}};
}

}  // namespace

// The rotation is one about the axis by phi, then one that turns the axis: of the quaternion of the
// whole, tan(phi / 2) is the component along the axis over the scalar. Of a matrix R that makes
// sin(phi) : cos(phi) = n . axial(R) : tr R - n . R n, which is sharp at half a turn, too.
double off_about(const Vec3& axis, double angle, const Mat3& rotation) {
  const double along = axis.dot(rotation * axis);
  if (along <= 0.0) return 0.0;
  const Vec3 axial(rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0),
                   rotation(1, 0) - rotation(0, 1));
  const double phi = std::atan2(axis.dot(axial), rotation.trace() - along);
  return std::abs(std::remainder(angle - phi, 2.0 * std::numbers::pi));
}

model::Constraint::Turn turn_about(const Anchor& anchor, const Vec3& axis,
                                   const Prescribed& motion) {
  model::Constraint::Turn turn = turn_by(motion);
  turn.off = [axis, axes = axes_of(anchor)](double angle, const Eigen::Matrix3Xd& q) {
    return off_about(axis, angle, rotation_of(axes, q));
  };
  return turn;
}

model::Constraint::Turn turn_between(const MarkerPair& pair, const Vec3& axis,
                                     const Prescribed& motion) {
  model::Constraint::Turn turn = turn_by(motion);
  turn.off = [axis, first = axes_of(pair, 0), second = axes_of(pair, 1)](
                 double angle, const Eigen::Matrix3Xd& q) {
    return off_about(axis, angle, rotation_of(first, q).transpose() * rotation_of(second, q));
  };
  return turn;
}

model::Constraint::Turn turn_of_all(const Anchor& anchor, const Vec3& axis,
                                    const Prescribed& motion) {
  model::Constraint::Turn turn = turn_by(motion);
  if (anchor.on_shell()) return turn;
  turn.off = [axis, axes = axes_of(anchor)](double angle, const Eigen::Matrix3Xd& q) {
    const Mat3 rest = exp_rotation(-angle * axis) * rotation_of(axes, q);
    return std::acos(std::clamp(0.5 * (rest.trace() - 1.0), -1.0, 1.0));
  };
  return turn;
}

}  // namespace culm::joint
