#include <culm/model/held_point.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace culm::model {

bool HeldPoint::describes(const Constraint& constraint, const NodeTable& nodes) {
  const std::vector<ConstraintRow>& rows = constraint.rows;
  return !constraint.is_driven() && !rows.empty() && rows.size() <= max_rows &&
         constraint.nodes.size() <= max_nodes &&
         std::ranges::all_of(rows,
                             [&](const ConstraintRow& row) {
                               return row.linear() && row.alpha == rows.front().alpha;
                             }) &&
         std::ranges::all_of(constraint.nodes, [&](int node) { return nodes.turns(node); });
}

HeldPoint::HeldPoint(const Constraint& constraint, int first_multiplier, double measure)
    : num_nodes_(static_cast<int>(constraint.nodes.size())),
      num_rows_(static_cast<int>(constraint.rows.size())),
      first_multiplier_(first_multiplier),
      measure_(measure) {
  std::ranges::copy(constraint.nodes, nodes_.begin());
  std::ranges::copy(constraint.rows.front().alpha, alpha_.begin());
  for (int k = 0; k < num_rows_; ++k) {
    directions_.col(k) = constraint.rows[index(k)].direction;
    constants_[k] = constraint.rows[index(k)].constant;
  }
}

HeldPoint::Share HeldPoint::share(int a, const NodeTable& nodes, const State& state,
                                  double theta) const {
  const int node = nodes_[index(a)];
  const auto alpha = alpha_of(a);
  const auto arm = [&](const Coordinates& q) {
    const auto slots = NodeTable::slots(q, node);
    Vec3 turned = slots.rightCols<3>().lazyProduct(alpha.tail<3>());
    if (nodes.is_slave(node)) {
      turned += alpha[0] * (slots.col(0) - NodeTable::slots(q, nodes.master(node)).col(0));
    }
    return turned;
  };
  Share share{alpha[0], {}, arm(state.next)};
  share.arm_mid = theta == 1.0 ? share.arm_next
                               : Vec3((1.0 - theta) * arm(state.prev) + theta * share.arm_next);
  return share;
}

Verdict HeldPoint::assemble(std::size_t i, const NodeTable& nodes, const Placement& placement,
                            const State& state, const Stencil& stencil, Want want,
                            Target& target) const {
  const Eigen::Map<const Eigen::VectorXd> lambda(state.multipliers.data() + first_multiplier_,
                                                 num_rows_);
  const Vec3 force = directions_.leftCols(num_rows_).lazyProduct(lambda);
  std::array<Share, max_nodes> shares;
  Vec3 point = Vec3::Zero();
  for (int a = 0; a < num_nodes_; ++a) {
    Share& one = shares[index(a)];
    one = share(a, nodes, state, stencil.theta);
    point += NodeTable::slots(state.next, nodes_[index(a)]).lazyProduct(alpha_of(a));
    Vec6 on_node;
    on_node << one.of_position * force, one.arm_mid.cross(force);
    if (!std::isfinite(on_node.sum())) return Verdict::not_finite;
    target.force_scale = std::max(target.force_scale, on_node.lpNorm<Eigen::Infinity>());
    placement.scatter.add_residual(i, a, on_node.data(), target);
  }
  const Vec3 h = directions_.transpose().lazyProduct(point) - constants_;
  if (!std::isfinite(h.sum())) return Verdict::not_finite;
  target.constraint_violation =
      std::max(target.constraint_violation, h.lpNorm<Eigen::Infinity>() / measure_);
  const Vec3 scaled = target.multiplier_scale * h;
  placement.scatter.add_residual(i, num_nodes_, scaled.data(), target);
  if (want == Want::residual) return Verdict::ok;
  switch (num_rows_) {
    case 1:
      add_tangent<1>(i, placement, shares, force, stencil.theta, target);
      break;
    case 2:
      add_tangent<2>(i, placement, shares, force, stencil.theta, target);
      break;
    default:
      add_tangent<3>(i, placement, shares, force, stencil.theta, target);
  }
  return Verdict::ok;
}

template <int Rows>
void HeldPoint::add_tangent(std::size_t i, const Placement& placement,
                            const std::array<Share, max_nodes>& shares, const Vec3& force,
                            double theta, Target& target) const {
  const Eigen::Matrix<double, 3, Rows> w =
      target.multiplier_scale * directions_.template leftCols<Rows>();
  RowMat<6, 6> turning = RowMat<6, 6>::Zero();
  for (int a = 0; a < num_nodes_; ++a) {
    const Share& one = shares[index(a)];
    Eigen::Matrix<double, 6, Rows> columns;
    Eigen::Matrix<double, 6, Rows> rows;
    columns.template topRows<3>() = rows.template topRows<3>() = one.of_position * w;
    columns.template bottomRows<3>() = skew(one.arm_mid).lazyProduct(w);
    rows.template bottomRows<3>() = skew(one.arm_next).lazyProduct(w);
    placement.scatter.add_tangent(i, a, num_nodes_, columns, target);
    placement.scatter.add_tangent(i, num_nodes_, a, rows.transpose(), target);
    // [F][arm] = arm F^T - (F . arm) 1, see NullSpace::add_turning
    turning.bottomRightCorner<3, 3>() = theta * one.arm_next * force.transpose();
    turning.bottomRightCorner<3, 3>().diagonal().array() -= theta * one.arm_next.dot(force);
    placement.scatter.add_tangent(i, a, a, turning, target);
  }
}

}  // namespace culm::model
