/// Where a determinant changes its sign.
#pragma once

#include <culm/solver/linear_solver.hpp>

#include <functional>
#include <optional>

namespace culm::analysis {

/// A determinant at a place.
struct DeterminantAt {
  double place = 0.0;
  solver::Determinant determinant;
};

/// What a search for a zero came to.
struct DeterminantZero {
  double place = 0.0;                ///< of the zero
  double before = 0.0, after = 0.0;  ///< the nearest places on both sides with a determinant
  bool is_found = false;             ///< as exactly as rounding allows; otherwise it lies between
};

/// Comes near to the zero of a determinant between two places, where it has different signs, by
/// regula falsi (Illinois). The determinant of a large model changes by many powers of ten, so
/// where this hardly moves the middle is taken. Where there is no determinant at a place, it closes
/// in on that from both sides.
/// @param at  the determinant at a place between; nothing where it cannot be found
DeterminantZero approach_zero(const DeterminantAt& start, const DeterminantAt& end,
                              const std::function<std::optional<solver::Determinant>(double)>& at);

}  // namespace culm::analysis
