/// In which company and in which order the blocks of a matrix are eliminated.
#pragma once

#include <culm/parallel/partition.hpp>

#include <functional>
#include <span>
#include <vector>

namespace culm::solver {

/// Whether these blocks can be eliminated together, before all others: whether the part of the
/// matrix that they share is regular.
using IsRegular = std::function<bool(std::span<const int> blocks)>;

/// With which neighbour each block is eliminated; -1 if it needs none; its own number if there is
/// none that helps, so that it waits until all its neighbours are eliminated.
///
/// Multipliers of a joint have nothing on the diagonal. They become regular together with a body
/// that they act on. Blocks with the fewest such neighbours choose first, so that each finds one
/// for itself where that is possible; the others share one.
/// @source R. M. Karp, M. Sipser, Maximum matching in sparse random graphs, 1981
std::vector<int> find_hosts(const parallel::Graph& graph, const IsRegular& is_regular);

/// Blocks that are eliminated together, group after group, with little fill: approximate minimum
/// degree of the graph of the groups, by Eigen. @param host as found by find_hosts
/// @param first_kept  the first of the blocks at the end that are not eliminated; if there are any,
/// they are the last group
std::vector<std::vector<int>> order_groups(const parallel::Graph& graph,
                                           const std::vector<int>& host, int first_kept);

}  // namespace culm::solver
