/// A material point as constraints see it: positions and vectors fixed to it as sums of slots.
#pragma once

#include <culm/model/constraint.hpp>
#include <culm/model/structure.hpp>

#include <vector>

namespace culm::joint {

/// A point of a node, or of a beam between its nodes. There positions and directors are
/// interpolated, so what is fixed to the point is linear in the slots as well, and rows stay
/// quadratic.
/// @source formulation 2.1, 3.7
class Anchor {
 public:
  /// @param marker without offset
  Anchor(const model::NodeTable& nodes, const model::Marker& marker);
  Anchor(const model::NodeTable& nodes, int node) : Anchor(nodes, model::marker_at(node)) {}

  const std::vector<int>& nodes() const { return marker_.nodes; }
  /// The node, or -1 between nodes.
  int node() const { return marker_.nodes.size() == 1 ? marker_.nodes.front() : -1; }
  /// Whether the point is of a shell: position and one director, slots 0 and 1 of its nodes.
  bool on_shell() const { return on_shell_; }
  int num_slots() const { return static_cast<int>(q_.cols()); }
  /// Slots of the nodes side by side in the reference, shape (3, 4 n).
  const Eigen::Matrix3Xd& reference() const { return q_; }
  /// Position and directors in the reference; between nodes the directors need not be orthonormal.
  const Vec3& position() const { return position_; }
  const Mat3& directors() const { return directors_; }

  /// A unit vector normal to a unit axis in the reference that is at home in the directors, and so
  /// the same for an observer who turns with them: the longest projection of a director.
  Vec3 across(const Vec3& axis) const;

  /// Position of the point at `offset` in the directors.
  model::SlotSum point(const Vec3& offset = Vec3::Zero()) const;
  /// The first director, which is the only one of a shell.
  model::SlotSum director() const { return attached(Vec3::UnitX()); }
  /// Attached copy of a spatial vector in the reference.
  model::SlotSum vector(const Vec3& v) const;

 private:
  model::SlotSum attached(const Vec3& components) const;

  model::Marker marker_;
  Eigen::Matrix3Xd q_;
  Vec3 position_ = Vec3::Zero();
  Mat3 directors_ = Mat3::Zero();
  bool on_shell_ = false;
  Mat3 components_;  ///< of a spatial vector in the directors
};

}  // namespace culm::joint
