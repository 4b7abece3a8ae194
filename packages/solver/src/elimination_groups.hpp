/// In which order and in which company the blocks of a matrix are eliminated.
#pragma once

#include <culm/parallel/partition.hpp>

#include <vector>

namespace culm::solver {

/// Blocks that are eliminated together, group after group, with little fill: approximate minimum
/// degree of the graph of the groups, by Eigen.
///
/// A hollow block, whose diagonal is zero, has nothing to be eliminated with: the multipliers of a
/// joint. It joins a neighbour that is not hollow and has as many unknowns to spare; blocks with
/// the fewest such neighbours choose first. One that finds none comes after all its neighbours.
/// @source R. M. Karp, M. Sipser, Maximum matching in sparse random graphs, 1981
std::vector<std::vector<int>> order_groups(const parallel::Graph& graph,
                                           const std::vector<bool>& is_hollow);

}  // namespace culm::solver
