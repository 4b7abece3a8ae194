/// Small motions of a node with a triad.
#pragma once

#include <culm/model/node_table.hpp>

#include <vector>

namespace culm::load {

/// Displacement u of a node and its rotation theta = 1/2 sum D_i x d_i from the reference, about
/// the axes of space. Both are linear in the slots, so that what is linear in the motion keeps
/// energy exactly; theta is the sine of the angle about an axis.
class SmallMotion {
 public:
  SmallMotion(const model::NodeTable& nodes, int node) : nodes_{node} {
    const Mat<3, 4> slots = model::NodeTable::slots(nodes.reference(), node);
    map_.block<3, 3>(0, 0) = Mat3::Identity();
    for (int i = 1; i < 4; ++i) map_.block<3, 3>(3, 3 * i) = 0.5 * skew(Vec3(slots.col(i)));
    reference_ = map_ * Eigen::Map<const Vec<12>>(slots.data());
  }

  int node() const { return nodes_.front(); }
  /// The node as the list that items of several have.
  const std::vector<int>& nodes() const { return nodes_; }
  /// u [m] and theta.
  Vec6 motion(const model::Coordinates& q) const { return rates(q) - reference_; }
  /// Of slots that are rates or accelerations.
  Vec6 rates(const model::Coordinates& q) const {
    const Mat<3, 4> slots = model::NodeTable::slots(q, node());
    return map_ * Eigen::Map<const Vec<12>>(slots.data());
  }
  /// Forces on the slots whose work is F . Du + M . Dtheta: half of M x D_i on director i.
  Mat<3, 4> slot_forces(const Vec6& force) const {
    const Vec<12> flat = map_.transpose() * force;
    return Eigen::Map<const Mat<3, 4>>(flat.data());
  }
  /// Derivative of these by the slots, for that of the force by the motion.
  Mat<12, 12> slot_derivative(const Mat6& derivative) const {
    return map_.transpose() * derivative * map_;
  }

 private:
  std::vector<int> nodes_;
  Mat<6, 12> map_ = Mat<6, 12>::Zero();
  Vec6 reference_ = Vec6::Zero();
};

}  // namespace culm::load
