/// What the values of a matrix are like.
#pragma once

namespace culm::solver {

/// Whether a matrix is its own transpose, up to rounding.
enum class Symmetry { none, symmetric };

}  // namespace culm::solver
