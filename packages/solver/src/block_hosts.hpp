/// Which blocks of a matrix cannot be eliminated by themselves.
#pragma once

#include "block_rows.hpp"

#include <limits>
#include <vector>

namespace culm::solver {

/// Hosts of the blocks (`find_hosts`) by the present values. A part of the matrix counts as regular
/// if its pivots differ by less than 1e6, after rows and columns have been scaled to one size.
/// @param first_kept  the first of the blocks at the end that are not eliminated and so are no
/// hosts
/// @source D. Ruiz, A scaling algorithm to equilibrate both rows and columns norms, 2001
std::vector<int> choose_hosts(const BlockRows& rows,
                              int first_kept = std::numeric_limits<int>::max());

}  // namespace culm::solver
