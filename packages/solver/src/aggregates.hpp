/// Groups of neighbouring nodes that become one node of the next grid.
#pragma once

#include "grid_level.hpp"

#include <vector>

namespace culm::solver {

struct Aggregates {
  std::vector<int> of_node;  ///< of each node of this rank
  int count = 0;
};

/// A node with all its neighbours, where these are free; what is left joins the aggregate with
/// which it has most neighbours. Aggregates do not cross ranks. A node that is carried stays alone.
/// @source P. Vanek, J. Mandel, M. Brezina, Algebraic multigrid by smoothed aggregation, 1996
Aggregates aggregate(const GridLevel& grid, const std::vector<bool>& carried);

}  // namespace culm::solver
