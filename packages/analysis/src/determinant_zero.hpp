/// Where a determinant changes its sign.
#pragma once

#include <culm/solver/linear_solver.hpp>

#include <functional>
#include <optional>

namespace culm::analysis {

/// Comes near to the zero of a determinant between 0 and `length`, where it has these values, by
/// regula falsi (Illinois). The determinant of a large model changes by many powers of ten, so
/// where this hardly moves the middle is taken.
/// @param at  the determinant at a place between; nothing where it cannot be found, which ends the
///            search
/// @return the last place with a determinant; 0 if there is none, or if both ends have one sign
double approach_zero(const solver::Determinant& at_start, const solver::Determinant& at_end,
                     double length,
                     const std::function<std::optional<solver::Determinant>(double)>& at);

}  // namespace culm::analysis
