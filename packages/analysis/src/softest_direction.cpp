#include "softest_direction.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace culm::analysis {

using assembly::Vector;

Vector irregular(const assembly::Rows& rows) {
  Vector v(rows);
  const auto values = v.values();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto global = static_cast<double>(rows.global(i));
    values[i] = std::fmod(0.6180339887498949 * (global + 1.0), 1.0) - 0.4;
  }
  return v;
}

// The first solution holds what is free, and as much of what is soft as the start has; the second
// has no more of stiff directions than rounding.
std::optional<Vector> softest_direction(solver::LinearSolver& linear, const assembly::Rows& rows) {
  Vector direction = irregular(rows);
  Vector response(rows);
  for (int i = 0; i < 2; ++i) {
    if (!linear.solve(direction, response).is_sound()) return {};
    const double size = response.largest();
    if (!std::isfinite(size) || size == 0.0) return {};
    response.scale(1.0 / size);
    std::swap(direction, response);
  }
  return direction;
}

double resistance(const assembly::Matrix& matrix, const Vector& direction) {
  Vector force(matrix.rows());
  matrix.multiply(direction, force);
  const double energy = std::abs(direction.dot(force));
  const std::vector<double> diagonal = matrix.diagonal();
  const auto forces = force.values();
  const auto motions = direction.values();
  for (std::size_t i = 0; i < forces.size(); ++i) forces[i] = std::abs(diagonal[i]) * motions[i];
  const double each = direction.dot(force);
  return each > 0.0 ? energy / each : 0.0;
}

bool sets_energy_free(const assembly::System& system, solver::LinearSolver& linear) {
  if (system.model().unknowns().num_forces() > 0) return false;
  const solver::Determinant determinant = linear.determinant();
  const std::optional<int> negative = determinant.negative;
  // of a solver without factors nothing is asked
  if (determinant.sign == 0 || (negative && *negative == 0)) return false;
  const assembly::Matrix& tangent = *system.matrix();
  const auto softest = softest_direction(linear, system.layout().rows());
  if (!softest || resistance(tangent, *softest) < least_resistance) return false;
  const Vector other = irregular(system.layout().rows());
  Vector force(other.rows()), other_force(other.rows());
  tangent.multiply(*softest, force);
  tangent.multiply(other, other_force);
  const double one = other.dot(force), transposed = softest->dot(other_force);
  // stiff directions leave rounding of what is large, though the softest one has little of them
  constexpr double small = 1e-8, rounding = 1e-13;
  const double terms = std::sqrt(other.dot(other) * force.dot(force));
  const double most = small * terms + rounding * tangent.norm() * std::sqrt(softest->dot(*softest));
  return (negative || softest->dot(force) < 0.0) && std::abs(one - transposed) <= most;
}

}  // namespace culm::analysis
