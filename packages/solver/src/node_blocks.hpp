/// Rows of nodes of one grid over nodes of a coarser one.
#pragma once

#include <culm/parallel/comm.hpp>

#include <cstddef>
#include <vector>

namespace culm::solver {

/// Dense blocks, node by node.
struct NodeBlocks {
  /// Of a coarse node, named by the global number of its first unknown.
  struct Block {
    long long first_unknown = 0;
    int width = 0;
    std::size_t value = 0;  ///< of its first value; row after row
  };
  std::vector<int> heights;           ///< rows of each node
  std::vector<std::size_t> first{0};  ///< block of each node, and the end
  std::vector<Block> blocks;
  std::vector<double> values;

  int nodes() const { return static_cast<int>(heights.size()); }
  /// Adds a block of zeros to the last node. @return its first value
  double* add_block(long long first_unknown, int width);
  /// Begins the next node.
  void add_node(int height);
};

/// The rows of nodes that other ranks have. @param begin where the nodes of each rank begin, and
/// the end @param wanted numbers of the nodes. Collective.
NodeBlocks import_nodes(const NodeBlocks& mine, const std::vector<long long>& begin,
                        const std::vector<long long>& wanted, const parallel::Comm& comm);

}  // namespace culm::solver
