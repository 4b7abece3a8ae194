/// Rows of constraints that are sums of several products.
#pragma once

#include <culm/model/constraint.hpp>

#include <vector>

namespace culm::model {

/// A product of two sums of slots, P . Q.
struct SlotProduct {
  SlotSum alpha;  ///< of P
  SlotSum beta;   ///< of Q
};

/// sum_t P_t . Q_t - c, with c such that h = 0 at `q`, the slots of the nodes side by side, shape
/// (3, 4 n). @pre at most max_products
ConstraintRow sum_row(const std::vector<SlotProduct>& products, const Eigen::Matrix3Xd& q);

/// Largest number of products of a row.
constexpr int max_products = 3;

/// How many products a row of a constraint of n nodes has; one where it is linear.
int number_of_products(const ConstraintRow& row, int nodes);

/// The derivative of h by each of the slots, shape (3, 4 n).
Eigen::Matrix3Xd row_gradient(const ConstraintRow& row, const Eigen::Matrix3Xd& q);

}  // namespace culm::model
