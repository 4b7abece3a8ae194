/// Intensities along a line by positions and values.
#pragma once

#include <culm/math/types.hpp>
#include <culm/model/structure.hpp>

#include <vector>

namespace culm::load {

/// Forces and moments per length, linear between positions; none before the first position and
/// beyond the last. At two equal positions they jump.
struct LineTable {
  std::vector<double> positions;  ///< from the start of the line, not descending [m]
  std::vector<Vec6> values;       ///< forces, moments [N/m, N m/m]
};

/// Length of a line as its elements measure it [m].
double length_of(const std::vector<model::LinePoint>& line);

/// The intensity at each point of a line with which the points of an element do the work of the
/// table on all its shape functions, however the table kinks or jumps within the element:
///   f_k = 1/(w_k J_k) int f(s(xi)) l_k(xi) J(xi) dxi      J = ds/dxi
/// with l_k the Lagrange polynomials on the n Gauss points xi_k of the element. Where nodes are
/// evenly spaced this is the best approximation of f of degree n - 1; the rule is exact for its
/// product with shape functions of that degree. Where f is linear in an element it is f(s_k).
/// @pre the points of an element follow each other and are those of gauss_legendre
std::vector<Vec6> intensities(const LineTable& table, const std::vector<model::LinePoint>& line);

}  // namespace culm::load
