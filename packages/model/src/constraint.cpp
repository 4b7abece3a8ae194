#include <culm/base/error.hpp>
#include <culm/model/constraint.hpp>
#include <culm/model/product_sum.hpp>

#include <utility>

namespace culm::model {
namespace {

// The factors of one product of a row.
Eigen::Map<const Eigen::VectorXd> of_product(const SlotSum& factors, int product,
                                             const Eigen::Matrix3Xd& q) {
  return {factors.data() + product * q.cols(), q.cols()};
}

Vec3 sum(const SlotSum& factors, const Eigen::Matrix3Xd& q, int product = 0) {
  return q * of_product(factors, product, q);
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
  double value = sum(row.alpha, q).dot(second) - row.constant;
  for (int t = 1; t < number_of_products(row, static_cast<int>(q.cols()) / 4); ++t) {
    value += sum(row.alpha, q, t).dot(sum(row.beta, q, t));
  }
  return value;
}

ConstraintRow sum_row(const std::vector<SlotProduct>& products, const Eigen::Matrix3Xd& q) {
  internal_check(products.size() <= max_products, "a row has too many products");
  ConstraintRow row;
  for (const SlotProduct& one : products) {
    row.alpha.insert(row.alpha.end(), one.alpha.begin(), one.alpha.end());
    row.beta.insert(row.beta.end(), one.beta.begin(), one.beta.end());
  }
  row.constant = row_value(row, q);
  return row;
}

Vec3 vector_of(const SlotSum& factors, const Eigen::Matrix3Xd& q) { return sum(factors, q); }

int number_of_products(const ConstraintRow& row, int nodes) {
  return static_cast<int>(row.alpha.size()) / (4 * nodes);
}

Eigen::Matrix3Xd row_gradient(const ConstraintRow& row, const Eigen::Matrix3Xd& q) {
  if (row.linear()) return row.direction * of_product(row.alpha, 0, q).transpose();
  Eigen::Matrix3Xd gradient = row.direction * of_product(row.alpha, 0, q).transpose();
  for (int t = 0; t < number_of_products(row, static_cast<int>(q.cols()) / 4); ++t) {
    gradient += sum(row.beta, q, t) * of_product(row.alpha, t, q).transpose() +
                sum(row.alpha, q, t) * of_product(row.beta, t, q).transpose();
  }
  return gradient;
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
