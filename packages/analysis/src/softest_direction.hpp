/// The direction that a factored matrix resists least.
#pragma once

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

}  // namespace culm::analysis
