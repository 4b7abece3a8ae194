/// What rounding can leave of a residual.
#pragma once

#include <culm/assembly/system.hpp>

namespace culm::assembly {

/// Where a system was evaluated: parts of a state.
struct EvaluatedPoint {
  const model::Coordinates& prev;
  const model::Coordinates& next;
  const std::vector<double>& multipliers;
  const std::vector<double>& own;
};

/// Force rows out of balance by more than a limit, held against what rounding can leave in each.
struct RoundingCheck {
  /// Largest residual over the bound of its row; 0 if no row is above the limit.
  double share = 0.0;
  int unknown = -1;  ///< global number of the row with the largest residual; -1 likewise
};

/// Whether rounding can hold the residual of the last evaluation above a limit: in row i
/// eps (c sum_j |J_ij| |q_j| + n_i f), with the last tangent J, the sizes q_j of the unknowns
/// (1 for rotations), and n_i forces of size f. Each row is judged in its own unit; what is above
/// its bound is no rounding. Collective. @source formulation 5.1
/// @param limit  smaller residuals are not asked about [N, N m]
/// @param force_scale  Evaluation::force_scale
/// @param most  of a share above it no more need be known, which costs less
RoundingCheck check_rounding(const System& system, const EvaluatedPoint& point, double limit,
                             double force_scale, double most);

/// What rounding of the coordinates alone may store or set in motion in one step: eps^2 c |q|^T |J|
/// |q| over the nodes, with the last tangent J [J]. Collective.
double rounding_energy(const System& system, const EvaluatedPoint& point);

}  // namespace culm::assembly
