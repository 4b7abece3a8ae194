/// Lagrange shape functions of a line on equidistant nodes.
#pragma once

#include <culm/math/types.hpp>

namespace culm {

/// Shape functions of degree `Order` on [-1, 1], one per node; nodes are equidistant and follow the
/// line: node 0 at -1, node Order at +1.
template <int Order>
struct Lagrange {
  static_assert(Order >= 1 && Order <= 3);
  static constexpr int num_nodes = Order + 1;

  /// Natural coordinate of node a.
  static constexpr double node(int a) { return -1.0 + 2.0 * a / Order; }

  /// N_a(xi), shape (num_nodes).
  static Vec<num_nodes> values(double xi) {
    Vec<num_nodes> N;
    for (int a = 0; a < num_nodes; ++a) N[a] = product_without(a, a, xi) * scale(a);
    return N;
  }

  /// dN_a/dxi, shape (num_nodes). Product rule: each factor (xi - xi_b) is left out once.
  static Vec<num_nodes> derivatives(double xi) {
    Vec<num_nodes> dN = Vec<num_nodes>::Zero();
    for (int a = 0; a < num_nodes; ++a) {
      for (int b = 0; b < num_nodes; ++b) {
        if (b != a) dN[a] += product_without(a, b, xi) * scale(a);
      }
    }
    return dN;
  }

 private:
  // prod_b (xi - xi_b) over all nodes but `a` and `b`
  static constexpr double product_without(int a, int b, double xi) {
    double product = 1.0;
    for (int k = 0; k < num_nodes; ++k) {
      if (k != a && k != b) product *= xi - node(k);
    }
    return product;
  }
  // 1 / prod_b (xi_a - xi_b): makes N_a one at its own node
  static constexpr double scale(int a) { return 1.0 / product_without(a, a, node(a)); }
};

}  // namespace culm
