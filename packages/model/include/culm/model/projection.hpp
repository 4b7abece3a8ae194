/// Projection of slot quantities to the unknowns of a node, for both forms of the equations.
///
/// In the null-space form a node moves by (dx, dtheta): slot s changes by dx for the position and
/// by dtheta x arm_s, where the arm of a director is the director itself and the arm of the
/// position is the lever to the master of an eliminated node, zero otherwise. In the multiplier
/// form the unknowns are the coordinates. Kernels are templates on one of the two policies below.
/// @source formulation 6.1, 6.4, 6.7
#pragma once

#include <culm/model/node_table.hpp>
#include <culm/model/unknowns.hpp>

namespace culm::model {

/// Six unknowns per node.
struct NullSpace {
  static constexpr int width = 6;
  static constexpr Form form = Form::null_space;

  /// P^T B: rows of one node, (12, M) to (6, M).
  template <class B, class Arms, class R>
  static void reduce_rows(const B& rows, const Arms& arms, R&& reduced) {
    reduced.template topRows<3>() = rows.template topRows<3>();
    auto x = reduced.row(3), y = reduced.row(4), z = reduced.row(5);
    const auto d1 = rows.template middleRows<3>(3), d2 = rows.template middleRows<3>(6),
               d3 = rows.template middleRows<3>(9);
    x = arms(1, 1) * d1.row(2) - arms(2, 1) * d1.row(1) + arms(1, 2) * d2.row(2) -
        arms(2, 2) * d2.row(1) + arms(1, 3) * d3.row(2) - arms(2, 3) * d3.row(1);
    y = arms(2, 1) * d1.row(0) - arms(0, 1) * d1.row(2) + arms(2, 2) * d2.row(0) -
        arms(0, 2) * d2.row(2) + arms(2, 3) * d3.row(0) - arms(0, 3) * d3.row(2);
    z = arms(0, 1) * d1.row(1) - arms(1, 1) * d1.row(0) + arms(0, 2) * d2.row(1) -
        arms(1, 2) * d2.row(0) + arms(0, 3) * d3.row(1) - arms(1, 3) * d3.row(0);
    if (arms(0, 0) != 0.0 || arms(1, 0) != 0.0 || arms(2, 0) != 0.0) {
      const auto p = rows.template topRows<3>();
      x += arms(1, 0) * p.row(2) - arms(2, 0) * p.row(1);
      y += arms(2, 0) * p.row(0) - arms(0, 0) * p.row(2);
      z += arms(0, 0) * p.row(1) - arms(1, 0) * p.row(0);
    }
  }

  /// K += P_theta,a^T (A x I3) P_next,b for the scalars A, shape (4, 4), between nodes a and b.
  template <class A, class Arms, class K>
  static void add_pairs(const A& scalars, const Arms& arms_theta, const Arms& arms_next,
                        K&& block) {
    using Row3 = Eigen::Matrix<double, 1, 3>;
    for (int s = 0; s < 4; ++s) {
      // slot s of node a against all slots of node b: position scalar and summed arm
      const double k = scalars(s, 0);
      const Vec3 v = arms_next * scalars.row(s).transpose();
      if (k == 0.0 && v.isZero(0.0)) continue;
      if (s == 0) {
        block.template topLeftCorner<3, 3>().diagonal().array() += k;
        block.template topRightCorner<3, 3>() -= skew(v);
      }
      const Vec3 arm = arms_theta.col(s);
      if (k != 0.0) block.template bottomLeftCorner<3, 3>() += k * skew(arm);
      // -[arm][v] = (arm . v) 1 - v arm^T
      block.template bottomRightCorner<3, 3>() -= v * Row3(arm.transpose());
      block.template bottomRightCorner<3, 3>().diagonal().array() += arm.dot(v);
    }
  }

  /// K += theta sum_s [r_s][arm_s,next]: the projection turns with the node.
  /// @param r slot residual of the node, shape (3, 4)
  template <class R, class Arms, class K>
  static void add_turning(const R& r, const Arms& arms_next, double theta, K&& block) {
    Mat3 sum = Mat3::Zero();
    for (int s = 0; s < 4; ++s) {
      const Vec3 force = r.col(s);
      const Vec3 arm = arms_next.col(s);
      // [r][d] = d r^T - (r . d) 1
      sum.noalias() += arm * force.transpose();
      sum.diagonal().array() -= force.dot(arm);
    }
    block.template bottomRightCorner<3, 3>() += theta * sum;
  }
};

/// Twelve unknowns per node: the identity as projection.
struct FullSpace {
  static constexpr int width = 12;
  static constexpr Form form = Form::multipliers;

  template <class B, class Arms, class R>
  static void reduce_rows(const B& rows, const Arms&, R&& reduced) {
    reduced = rows;
  }
  template <class A, class Arms, class K>
  static void add_pairs(const A& scalars, const Arms&, const Arms&, K&& block) {
    for (int s = 0; s < 4; ++s) {
      for (int t = 0; t < 4; ++t) {
        block.template block<3, 3>(3 * s, 3 * t).diagonal().array() += scalars(s, t);
      }
    }
  }
  template <class R, class Arms, class K>
  static void add_turning(const R&, const Arms&, double, K&&) {}
};

/// Arms of a node: its slots, with the lever to its master in place of the position.
inline NodeSlots arms_of(const NodeTable& nodes, int node, const Coordinates& q) {
  NodeSlots arms = NodeTable::slots(q, node);
  if (nodes.is_slave(node)) {
    arms.col(0) -= NodeTable::slots(q, nodes.master(node)).col(0);
  } else {
    arms.col(0).setZero();
  }
  return arms;
}

}  // namespace culm::model
