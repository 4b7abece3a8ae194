/// Projection of slot quantities to the unknowns of a node, for both forms of the equations.
///
/// In the null-space form a triad node moves by (dx, dtheta): slot s changes by dx for the position
/// and by dtheta x arm_s, where the arm of a director is the director itself and the arm of the
/// position is the lever to the master of an eliminated node, zero otherwise. The slots of a shell
/// node are its unknowns, unless it is eliminated in favour of a triad node. In the multiplier form
/// the unknowns are the coordinates. Kernels are templates on one of the two policies below.
/// @source formulation 6.1, 6.4, 6.7
#pragma once

#include <culm/model/node_table.hpp>
#include <culm/model/unknowns.hpp>

namespace culm::model {

/// How the K slots of a node move with the unknowns of its block.
template <int K = 4>
struct Arms {
  Mat<3, K> slots;    ///< what a rotation of the block turns
  bool turns = true;  ///< false: the slots x, d are the unknowns themselves
};

/// Arms between both ends of a step.
template <int K>
Arms<K> at_theta(double theta, const Arms<K>& prev, const Arms<K>& next) {
  return {(1.0 - theta) * prev.slots + theta * next.slots, next.turns};
}

/// Six unknowns per node.
struct NullSpace {
  static constexpr int width = 6;
  static constexpr Form form = Form::null_space;

  /// P^T B: rows of one node, (3 K, M) to (6, M).
  template <class B, int K, class R>
  static void reduce_rows(const B& rows, const Arms<K>& arms, R&& reduced) {
    if (!arms.turns) {
      reduced = rows.template topRows<6>();
      return;
    }
    constexpr int columns = B::ColsAtCompileTime;
    // a local sum, so that the compiler sees that it aliases nothing and runs along the columns
    Eigen::Matrix<double, 3, columns, columns == 1 ? Eigen::ColMajor : Eigen::RowMajor, 3,
                  B::MaxColsAtCompileTime>
        turn;
    turn.setZero(3, rows.cols());
    const bool has_lever = !arms.slots.col(0).isZero(0.0);
    for (int s = has_lever ? 0 : 1; s < K; ++s) {
      const double x = arms.slots(0, s), y = arms.slots(1, s), z = arms.slots(2, s);
      for (int m = 0; m < rows.cols(); ++m) {
        const double f = rows(3 * s, m), g = rows(3 * s + 1, m), h = rows(3 * s + 2, m);
        turn(0, m) += y * h - z * g;
        turn(1, m) += z * f - x * h;
        turn(2, m) += x * g - y * f;
      }
    }
    reduced.template topRows<3>() = rows.template topRows<3>();
    reduced.template bottomRows<3>() = turn;
  }

  /// K += P_theta,a^T (A x I3) P_next,b for the scalars A, shape (K, K), between nodes a and b.
  template <class A, int K, class Block>
  static void add_pairs(const A& scalars, const Arms<K>& arms_theta, const Arms<K>& arms_next,
                        Block&& block) {
    if (!arms_theta.turns || !arms_next.turns) {
      add_free_pairs(scalars, arms_theta, arms_next, block);
      return;
    }
    // slots of node a against all of node b: summed arms; then their product with the arms of a
    const Mat<3, K> V = arms_next.slots.lazyProduct(scalars.transpose());
    const Mat3 W = V.lazyProduct(arms_theta.slots.transpose());
    block.template topLeftCorner<3, 3>().diagonal().array() += scalars(0, 0);
    block.template topRightCorner<3, 3>() -= skew(V.col(0));
    block.template bottomLeftCorner<3, 3>() += skew(arms_theta.slots.lazyProduct(scalars.col(0)));
    // -[arm][v] = (arm . v) 1 - v arm^T
    block.template bottomRightCorner<3, 3>() -= W;
    block.template bottomRightCorner<3, 3>().diagonal().array() += W.trace();
  }

  /// K += theta sum_s [r_s][arm_s,next]: the projection turns with the node.
  /// @param r slot residual of the node, shape (3, K)
  template <class R, int K, class Block>
  static void add_turning(const R& r, const Arms<K>& arms_next, double theta, Block&& block) {
    if (!arms_next.turns) return;
    // [r][d] = d r^T - (r . d) 1
    const Mat3 sum = theta * arms_next.slots.lazyProduct(r.transpose());
    block.template bottomRightCorner<3, 3>() += sum;
    block.template bottomRightCorner<3, 3>().diagonal().array() -= sum.trace();
  }

 private:
  // The same where at least one node moves freely: its slots 0 and 1 are its unknowns.
  template <class A, int K, class Block>
  static void add_free_pairs(const A& scalars, const Arms<K>& arms_theta, const Arms<K>& arms_next,
                             Block&& block) {
    if (arms_theta.turns) {
      for (int t = 0; t < 2; ++t) {
        block.template block<3, 3>(0, 3 * t).diagonal().array() += scalars(0, t);
        block.template block<3, 3>(3, 3 * t) += skew(arms_theta.slots.lazyProduct(scalars.col(t)));
      }
    } else if (arms_next.turns) {
      for (int s = 0; s < 2; ++s) {
        block.template block<3, 3>(3 * s, 0).diagonal().array() += scalars(s, 0);
        block.template block<3, 3>(3 * s, 3) -=
            skew(arms_next.slots.lazyProduct(scalars.row(s).transpose()));
      }
    } else {
      for (int s = 0; s < 2; ++s) {
        for (int t = 0; t < 2; ++t) {
          block.template block<3, 3>(3 * s, 3 * t).diagonal().array() += scalars(s, t);
        }
      }
    }
  }
};

/// Twelve unknowns per triad node, six per shell node: the identity as projection. Kernels write
/// twelve for both; of a shell node the first six are taken (Scatter).
struct FullSpace {
  static constexpr int width = 12;
  static constexpr Form form = Form::multipliers;

  template <class B, int K, class R>
  static void reduce_rows(const B& rows, const Arms<K>&, R&& reduced) {
    reduced = rows;
  }
  template <class A, int K, class Block>
  static void add_pairs(const A& scalars, const Arms<K>&, const Arms<K>&, Block&& block) {
    for (int s = 0; s < K; ++s) {
      for (int t = 0; t < K; ++t) {
        block.template block<3, 3>(3 * s, 3 * t).diagonal().array() += scalars(s, t);
      }
    }
  }
  template <class R, int K, class Block>
  static void add_turning(const R&, const Arms<K>&, double, Block&&) {}
};

/// Arms of a node in a configuration: its slots, with the lever to its master in place of the
/// position.
inline Arms<4> arms_of(const NodeTable& nodes, int node, const Coordinates& q) {
  Arms<4> arms{NodeTable::slots(q, node), nodes.turns(node)};
  if (nodes.is_slave(node)) {
    arms.slots.col(0) -= NodeTable::slots(q, nodes.master(node)).col(0);
  } else {
    arms.slots.col(0).setZero();
  }
  return arms;
}

}  // namespace culm::model
