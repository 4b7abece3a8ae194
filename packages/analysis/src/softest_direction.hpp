/// The direction that a factored matrix resists least.
#pragma once

#include <culm/assembly/system.hpp>
#include <culm/solver/linear_solver.hpp>

#include <optional>

namespace culm::analysis {

/// Entries without any symmetry, the same for any number of ranks.
assembly::Vector irregular(const assembly::Rows& rows);

/// By inverse iteration with the last factors, of unit maximum norm. Nothing is shifted, so that
/// what is free is found beside stiffnesses of any size. Empty where a solution is not sound.
/// Collective.
std::optional<assembly::Vector> softest_direction(solver::LinearSolver& linear,
                                                  const assembly::Rows& rows);

/// |v . A v| over the sum of |a_ii| v_i^2: by how much a direction is resisted, of what would
/// resist each of its motions by itself. Of energies, so it does not depend on the units of lengths
/// and rotations; 0 where there is nothing to compare with. Collective.
double resistance(const assembly::Matrix& matrix, const assembly::Vector& direction);

/// What is resisted by less is not resisted: several digits above rounding, and below slender
/// beams.
constexpr double least_resistance = 1e-13;

/// Whether some motion sets energy free by the last tangent, as it was factored: by the number of
/// its negative eigenvalues, or, where the factors do not tell, in its softest direction. Two
/// directions that lose their stiffness together, as those in which a round column bends, leave the
/// determinant its sign; this shows them. False of tangents that are not symmetric or have
/// multipliers. Collective.
bool sets_energy_free(const assembly::System& system, solver::LinearSolver& linear);

}  // namespace culm::analysis
