#include <culm/model/constraint.hpp>

#include <utility>

namespace culm::model {
namespace {

Vec3 sum(const SlotSum& factors, const Eigen::Matrix3Xd& q) {
  return q * Eigen::Map<const Eigen::VectorXd>(factors.data(), q.cols());
}

}  // namespace

ConstraintRow linear_row(const Vec3& direction, SlotSum alpha, const Eigen::Matrix3Xd& q) {
  ConstraintRow row;
  row.direction = direction;
  row.constant = direction.dot(sum(alpha, q));
  row.alpha = std::move(alpha);
  return row;
}

ConstraintRow product_row(SlotSum alpha, SlotSum beta, const Eigen::Matrix3Xd& q,
                          const Vec3& origin) {
  ConstraintRow row;
  row.direction = -origin;
  row.constant = sum(alpha, q).dot(sum(beta, q) - origin);
  row.alpha = std::move(alpha);
  row.beta = std::move(beta);
  return row;
}

SlotSum attached_point(int a, int n, const Vec3& offset) {
  SlotSum factors = attached_vector(a, n, offset);
  factors[static_cast<std::size_t>(4 * a)] = 1.0;
  return factors;
}

SlotSum attached_vector(int a, int n, const Vec3& nu) {
  SlotSum factors(static_cast<std::size_t>(4 * n), 0.0);
  for (int k = 0; k < 3; ++k) factors[static_cast<std::size_t>(4 * a + 1 + k)] = nu[k];
  return factors;
}

double row_value(const ConstraintRow& row, const Eigen::Matrix3Xd& q) {
  const Vec3 second = row.linear() ? row.direction : Vec3(row.direction + sum(row.beta, q));
  return sum(row.alpha, q).dot(second) - row.constant;
}

Eigen::Matrix3Xd slots_of(const Constraint& constraint, const Coordinates& q) {
  Eigen::Matrix3Xd slots(3, 4 * static_cast<int>(constraint.nodes.size()));
  int at = 0;
  for (int node : constraint.nodes) {
    slots.middleCols<4>(at) = NodeTable::slots(q, node);
    at += 4;
  }
  return slots;
}

Constraint internal_constraint(const NodeTable& nodes, int node) {
  Constraint constraint;
  constraint.name = "directors of node " + std::to_string(node);
  constraint.type = "Internal, unit directors";
  constraint.nodes = {node};
  constraint.is_internal = true;
  const Eigen::Matrix3Xd q = NodeTable::slots(nodes.reference(), node);
  constexpr int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  for (const auto& [i, j] : pairs) {
    // half of d_i . d_i, so that H has d_i itself as in formulation 2.2
    const double factor = i == j ? 0.5 : 1.0;
    constraint.rows.push_back(product_row(attached_vector(0, 1, factor * Vec3::Unit(i)),
                                          attached_vector(0, 1, Vec3::Unit(j)), q));
  }
  return constraint;
}

}  // namespace culm::model
